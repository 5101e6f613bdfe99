#include "session/attempt/interrupted_attempt.h"

#include "assessment/score.h"
#include "session/case/case_build.h"
#include "sim/base/failure.h"
#include "sim/engine/step.h"

namespace seldinger::session {
namespace {

// Empty where nothing can be said: its case cannot be built any more, or nothing was recorded.
assessment::Scored score_of(casedb::Library& library, const casedb::OpenAttempt& attempt) {
  const auto recording = casedb::load_open_recording(library, attempt.attempt_id);
  const auto row = casedb::find_case(library, attempt.case_id);
  if (!recording || recording->poses.empty() || !row) return {};
  for (const casedb::LesionRow& lesion : casedb::list_lesions(library, attempt.case_id))
    if (lesion.lesion_id == attempt.lesion_id) {
      auto scene = build_case(library, *row, lesion.form, attempt.picture, Needs::metrics);
      if (!scene) return {};
      scene->instrument = attempt.instrument;
      scene->approach = attempt.approach;
      auto scored = assessment::score(*scene, *recording);
      return scored ? std::move(*scored) : assessment::Scored{};
    }
  return {};
}

// Whether a tick left behind what the recording has next; `poses`: how many of it came before.
bool as_recorded(const cases::RecordedTick& tick, const cases::Recording& recording, std::size_t at,
                 std::size_t& poses) {
  if (tick.hash != recording.hashes[at]) return false;
  if (!tick.pose) return true;
  const std::size_t pose = poses++;
  if (pose >= recording.poses.size() || !(recording.poses[pose] == *tick.pose)) return false;
  if (!tick.force || recording.forces.empty()) return true;
  return pose < recording.forces.size() && recording.forces[pose] == *tick.force;
}

}  // namespace

base::Result<InterruptedAttempt> InterruptedAttempt::take(casedb::Library& library, const std::string& attempt_id) {
  if (casedb::is_running(library.folder(), attempt_id))
    return base::Error{"attempt_runs", "somebody is at this attempt now"};
  InterruptedAttempt taken;
  taken.mark_ = std::make_unique<casedb::RunningMark>(library.folder(), attempt_id);
  bool found = false;
  for (casedb::OpenAttempt& open : casedb::list_open_attempts(library))
    if (open.attempt_id == attempt_id) {
      taken.attempt_ = std::move(open);
      found = true;
    }
  if (!found)
    return base::Error{"no_attempt", "there is no such open attempt in the library: it has ended, or never was"};
  auto recording = casedb::load_open_recording(library, attempt_id);
  if (!recording) return recording.error();
  if (recording->inputs.empty())
    return base::Error{"nothing_recorded", "the attempt ended before anything of it was stored"};
  taken.recording_ = std::move(*recording);
  return taken;
}

base::Result<void> InterruptedAttempt::replay(const cases::Case& scene, const Replayed& replayed) {
  if (recording_.step_version != engine::kStepVersion)
    return base::Error{"step_version", "the attempt was recorded by step version " +
                                           std::to_string(recording_.step_version) + ", and this program has " +
                                           std::to_string(engine::kStepVersion) + ": it cannot go on"};
  const engine::Tick tick(scene);
  now_ = {};
  pulse_.reset();
  std::size_t poses = 0;
  for (std::size_t i = 0; i < recording_.inputs.size(); ++i) {
    const cases::Inputs& inputs = recording_.inputs[i];
    if (replayed) replayed(now_.state, inputs);
    if (!as_recorded(tick.advance(inputs, recording_.dt_s, now_), recording_, i, poses))
      return base::Error{"not_the_same", "tick " + std::to_string(i + 1) +
                                             " of the recording does not come out as it was recorded: the attempt "
                                             "cannot go on"};
    if (now_.state.fluoroscopy.frame_due) pulse_ = engine::moment_of(now_);
  }
  const cases::Inputs& last = recording_.inputs.back();
  now_.arms = {{last.needle, true}, {last.probe, true}};
  return {};
}

bool is_interrupted(const casedb::Library& library, const casedb::OpenAttempt& attempt) {
  return attempt.chunks > 0 && !casedb::is_running(library.folder(), attempt.attempt_id);
}

std::optional<casedb::OpenAttempt> find_interrupted(casedb::Library& library, const std::string& person_id,
                                                    const std::string& case_id) {
  std::optional<casedb::OpenAttempt> newest;
  for (casedb::OpenAttempt& open : casedb::list_open_attempts(library))
    if (!open.synthetic() && open.person_id == person_id && open.case_id == case_id &&
        is_interrupted(library, open))
      newest = std::move(open);
  return newest;
}

bool close_interrupted_attempt(casedb::Library& library, const casedb::OpenAttempt& attempt) {
  if (casedb::is_running(library.folder(), attempt.attempt_id)) return false;
  casedb::AttemptOutcome outcome;
  outcome.end = casedb::AttemptEnd::interrupted;
  assessment::Scored scored = score_of(library, attempt);
  outcome.metrics = std::move(scored.metrics);
  outcome.steps = std::move(scored.steps);
  // Another process may have been faster.
  return casedb::close_attempt(library, attempt.attempt_id, outcome).has_value();
}

std::vector<std::string> close_interrupted_attempts(casedb::Library& library, const Spared& spared) {
  std::vector<std::string> closed;
  for (const casedb::OpenAttempt& attempt : casedb::list_open_attempts(library))
    if (!(spared && spared(attempt)) && close_interrupted_attempt(library, attempt))
      closed.push_back(attempt.attempt_id);
  return closed;
}

}  // namespace seldinger::session
