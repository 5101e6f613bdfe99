// recompute.
#include <bit>
#include <cmath>
#include <cstdio>

#include "app/acting/acting.h"
#include "app/attempts/answers_json.h"
#include "app/cli/command.h"
#include "app/cli/progress.h"
#include "assessment/score.h"
#include "session/case/case_build.h"

namespace seldinger::app {
namespace {

constexpr double kSame = 1e-9;  // relative, across builds: our judgement

bool same_bits(const std::optional<double>& a, const std::optional<double>& b) {
  return a.has_value() == b.has_value() &&
         (!a || std::bit_cast<std::uint64_t>(*a) == std::bit_cast<std::uint64_t>(*b));
}
bool close(const std::optional<double>& a, const std::optional<double>& b) {
  return a.has_value() == b.has_value() && (!a || std::abs(*a - *b) <= kSame * std::max(1.0, std::abs(*a)));
}

// Attempts at one lesion share what is costly of its case.
class Scenes {
 public:
  explicit Scenes(casedb::Library& library) : library_(library) {}

  base::Result<cases::Case*> of(const casedb::AttemptRow& attempt) {
    if (lesion_id_ != attempt.lesion_id) {  // a lesion is one of its case
      lesion_id_.clear();
      auto built = session::build_case_of(library_, attempt, session::Needs::metrics);
      if (!built) return built.error();
      scene_ = std::move(*built);
      lesion_id_ = attempt.lesion_id;
    }
    scene_.instrument = attempt.instrument;
    scene_.picture = attempt.picture;
    scene_.approach = attempt.approach;
    return &scene_;
  }

 private:
  casedb::Library& library_;
  std::string lesion_id_;
  cases::Case scene_;
};

base::Result<void> recompute(casedb::Library& library, const casedb::AttemptRow& attempt, Scenes& scenes,
                             Recomputed& sum) {
  const auto scene = scenes.of(attempt);
  if (!scene) return scene.error();
  const auto recording = casedb::load_recording(library, attempt.attempt_id);
  if (!recording) return recording.error();
  const auto scored = assessment::score(**scene, *recording);
  if (!scored) return scored.error();
  for (const assessment::MetricValue& now : scored->metrics)
    for (const assessment::MetricValue& stored : attempt.metrics)
      if (stored.id == now.id && stored.version == now.version) {
        ++sum.values;
        if (!same_bits(stored.value, now.value)) ++sum.not_bit_identical;
        if (!close(stored.value, now.value))
          sum.differences.push_back({attempt.attempt_id, now.id, now.version, stored.value, now.value});
      }
  const auto added = casedb::add_metrics(library, attempt.attempt_id, scored->metrics);
  if (!added) return added.error();
  sum.added += *added;
  const auto steps_added = casedb::add_steps(library, attempt.attempt_id, scored->steps);
  if (!steps_added) return steps_added.error();
  sum.steps_added += *steps_added;
  return {};
}

int run_recompute(const Arguments& arguments) {
  auto library = open_acting(arguments);
  if (!library) return refuse(library.error());
  if (const auto by = acting(*library, arguments, casedb::Action::keep_library); !by) return refuse(by.error());
  std::vector<casedb::AttemptRow> attempts;
  if (arguments.has("--attempt")) {
    auto one = casedb::find_attempt(*library, arguments.text("--attempt"));
    if (!one) return refuse(one.error());
    attempts.push_back(std::move(*one));
  } else {
    attempts = casedb::list_attempts(*library);
  }
  casedb::audit_alone(*library, casedb::Act::recompute);
  std::stable_sort(attempts.begin(), attempts.end(),
                   [](const auto& a, const auto& b) { return a.case_id < b.case_id; });
  Recomputed sum;
  Scenes scenes(*library);
  {
    Progress progress(attempts.size());
    for (const casedb::AttemptRow& attempt : attempts) {
      ++sum.attempts;
      if (const auto done = recompute(*library, attempt, scenes, sum); !done)
        sum.not_scored.emplace_back(attempt.attempt_id, done.error());
      progress.one_done();
    }
  }
  // Once more, now that it is done: whoever keeps grades (casedb/grading/standings.h) asks whether it was.
  if (sum.added > 0) casedb::audit_alone(*library, casedb::Act::recompute);
  if (arguments.has("--json")) {
    std::fputs(json_of_recompute(sum).c_str(), stdout);
  } else {
    std::printf(
        "%zu attempts, %zu stored values compared: %zu differ, %zu not identical bit for bit; %zu added, and %zu "
        "steps\n",
        sum.attempts, sum.values, sum.differences.size(), sum.not_bit_identical, sum.added, sum.steps_added);
    for (const Recomputed::Difference& one : sum.differences)
      std::printf("DIFFERENT: %s %s version %d\n", one.attempt_id.c_str(), one.metric_id.c_str(), one.version);
    for (const auto& [attempt_id, error] : sum.not_scored)
      std::printf("not scored: %s: %s\n", attempt_id.c_str(), error.code.c_str());
  }
  return sum.differences.empty() ? kDone : kCheckFailed;
}

constexpr Option kRecomputeOptions[] = {
    kLibrary, {"--attempt", "ATTEMPT", "only this one; default: every attempt"}, kJson};

}  // namespace

Command recompute_command() {
  return {.name = "recompute",
          .options = kRecomputeOptions,
          .acts = true,
          .summary = "Scores stored attempts again: adds new versions of metrics, compares existing ones.",
          .run = &run_recompute};
}

}  // namespace seldinger::app
