// replay.
#include <cstdio>

#include "app/answers_json.h"
#include "app/attempt_loop.h"
#include "app/case_build.h"
#include "app/command.h"
#include "sim/engine/step.h"

namespace seldinger::app {
namespace {

struct Verdict {
  std::optional<bool> verified;
  std::optional<std::uint64_t> first_difference_tick;
  std::string reason;
};

base::Result<Verdict> verify(casedb::Library& library, const casedb::AttemptRow& attempt) {
  if (attempt.step_version != engine::kStepVersion)
    return Verdict{std::nullopt, std::nullopt, "recorded by another step version"};
  const auto recording = casedb::load_recording(library, attempt.attempt_id);
  if (!recording) return Verdict{false, std::nullopt, recording.error().text};
  const auto scene = build_case_of(library, attempt, recording->forces.empty() ? Needs::metrics : Needs::touch);
  if (!scene) return Verdict{false, std::nullopt, scene.error().text};
  const Replay replayed = replay(*scene, *recording);
  if (replayed.same) return Verdict{true, std::nullopt, ""};
  return Verdict{false, replayed.first_difference_tick, "the replayed state differs"};
}

}  // namespace

int run_replay(const Arguments& arguments) {
  auto library = casedb::Library::open(arguments.required("--library"));
  if (!library) return refuse(library.error());
  const auto attempt = casedb::find_attempt(*library, arguments.positional(0));
  if (!attempt) return refuse(attempt.error());
  const auto verdict = verify(*library, *attempt);
  if (!verdict) return refuse(verdict.error());
  if (arguments.has("--json"))
    std::fputs(json_of_replay(verdict->verified, verdict->first_difference_tick, verdict->reason).c_str(), stdout);
  else if (!verdict->verified)
    std::printf("not verified: %s\n", verdict->reason.c_str());
  else if (*verdict->verified)
    std::puts("verified: every tick's state and every pose are the same");
  else
    std::printf("DIFFERENT: %s (tick %llu)\n", verdict->reason.c_str(),
                static_cast<unsigned long long>(verdict->first_difference_tick.value_or(0)));
  const bool failed = verdict->verified.has_value() && !*verdict->verified;
  return failed ? kCheckFailed : kDone;
}

}  // namespace seldinger::app
