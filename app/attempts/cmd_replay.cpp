// replay.
#include <cstdio>
#include <filesystem>

#include "app/acting/acting.h"
#include "app/attempts/answers_json.h"
#include "app/cli/command.h"
#include "app/replay/replay_output.h"
#include "session/attempt/replayed_attempt.h"
#include "session/case/case_build.h"
#include "sim/engine/step.h"

namespace seldinger::app {
namespace {

struct Verdict {
  std::optional<bool> verified;
  std::optional<std::uint64_t> first_difference_tick;
  std::string reason;
};

Verdict verdict_of(const casedb::AttemptRow& attempt, const session::Replay& replayed) {
  if (attempt.step_version != engine::kStepVersion)
    return {std::nullopt, std::nullopt, "recorded by another version of the step"};
  if (replayed.same) return {true, std::nullopt, ""};
  return {false, replayed.first_difference_tick, "the replayed state differs"};
}

base::Result<Verdict> verify(casedb::Library& library, const casedb::AttemptRow& attempt) {
  if (attempt.step_version != engine::kStepVersion) return verdict_of(attempt, {});
  const auto recording = casedb::load_recording(library, attempt.attempt_id);
  if (!recording) return Verdict{false, std::nullopt, recording.error().text};
  const auto scene = session::build_case_of(
      library, attempt, recording->forces.empty() ? session::Needs::metrics : session::Needs::touch);
  if (!scene) return Verdict{false, std::nullopt, scene.error().text};
  return verdict_of(attempt, session::replay(*scene, *recording));
}

base::Result<Verdict> draw(casedb::Library& library, const casedb::AttemptRow& attempt, const Arguments& arguments,
                           double rate_hz) {
  const auto recording = casedb::load_recording(library, attempt.attempt_id);
  if (!recording) return recording.error();
  const std::string out = arguments.text("--out");
  const auto written = write_replay(library, attempt, *recording, out, rate_hz);
  if (!written) return written.error();
  Verdict verdict = verdict_of(attempt, written->replay);
  if (verdict.verified.value_or(true))
    std::fprintf(stderr, "%zu pictures of %.1f s in %.1f s: %s\n", written->pictures, attempt.duration_s,
                 written->seconds, out.c_str());
  return verdict;
}

int run_replay(const Arguments& arguments) {
  const double rate_hz = arguments.number("--rate-hz", kDefaultReplayHz, 1.0, kMostReplayHz);
  if (const std::string out = arguments.text("--out"); std::filesystem::path(out).has_extension())
    file_of("--out", out, {".html", ".mp4"});  // a folder's name has no ending
  auto library = open_library(arguments);
  if (!library) return refuse(library.error());
  const auto attempt = casedb::find_attempt(*library, arguments.positional(0));
  if (!attempt) return refuse(attempt.error());
  const auto verdict =
      arguments.has("--out") ? draw(*library, *attempt, arguments, rate_hz) : verify(*library, *attempt);
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

constexpr Option kReplayOptions[] = {
    kLibrary,
    {"--verify", nullptr, "replay the inputs and compare state hashes and poses, tick by tick"},
    {"--out", "FILE.html|FILE.mp4|DIR",
     "a sheet (pictures, path in the body, timeline, metrics), a film (needs ffmpeg), or a new folder of PNG "
     "frames; compared with the recording as it is drawn: if it differs, nothing is written"},
    {"--rate-hz", "R", "frames a second of the attempt, 1 to 60; default 10"},
    kJson};

}  // namespace

Command replay_command() {
  return {.name = "replay",
          .positionals = "ATTEMPT",
          .min_positionals = 1,
          .max_positionals = 1,
          .options = kReplayOptions,
          .summary = "Replays a stored attempt.",
          .run = &run_replay};
}

}  // namespace seldinger::app
