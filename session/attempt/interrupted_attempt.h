// An attempt that a program left behind when it died, brought to where its recording ends, so that somebody can go
// on with it (docs/decisions/0037).
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "casedb/attempts/attempts.h"
#include "casedb/database/running_mark.h"
#include "sim/base/result.h"
#include "sim/case/case.h"
#include "sim/case/record/recording.h"
#include "sim/engine/tick.h"

namespace seldinger::session {

class InterruptedAttempt {
 public:
  // While this is there, nobody else closes the attempt or goes on with it. Refused: `no_attempt` (there is no such
  // open attempt), `attempt_runs`, `nothing_recorded`, what load_open_recording refuses.
  static base::Result<InterruptedAttempt> take(casedb::Library& library, const std::string& attempt_id);

  const casedb::OpenAttempt& attempt() const noexcept { return attempt_; }
  const cases::Recording& recording() const noexcept { return recording_; }
  std::uint64_t ticks() const noexcept { return recording_.inputs.size(); }

  // Steps through what was recorded; the scene is the one that it was recorded in. Told of each tick: the state
  // before it, and what went into it. Refused: `step_version` (of another one), `not_the_same` (what comes of the
  // inputs is not what was recorded).
  using Replayed = std::function<void(const cases::State& before, const cases::Inputs& inputs)>;
  base::Result<void> replay(const cases::Case& scene, const Replayed& replayed = {});

  // From `replay` on: where it goes on. Recordings keep what the arms read, and not what hands asked of them: each
  // stands where it was read last.
  const engine::TickState& now() const noexcept { return now_; }
  // Of the last pulse of a fluoroscope; nothing: there was none.
  const std::optional<engine::Moment>& pulse() const noexcept { return pulse_; }

 private:
  InterruptedAttempt() = default;

  std::unique_ptr<casedb::RunningMark> mark_;
  casedb::OpenAttempt attempt_;
  cases::Recording recording_;
  engine::TickState now_;
  std::optional<engine::Moment> pulse_;
};

// Whether somebody could go on with it: it is nobody's now, and not at its very beginning.
bool is_interrupted(const casedb::Library& library, const casedb::OpenAttempt& attempt);
// The newest that a person left behind at a case.
std::optional<casedb::OpenAttempt> find_interrupted(casedb::Library& library, const std::string& person_id,
                                                    const std::string& case_id);

// Attempts that a program left behind when it died: each becomes an attempt that says so, with the score of what
// was recorded. Their ids. Those that are running, and those that `spared` names, are left alone.
using Spared = std::function<bool(const casedb::OpenAttempt&)>;
std::vector<std::string> close_interrupted_attempts(casedb::Library& library, const Spared& spared = {});
// One of them; false: somebody is at it, or it is closed.
bool close_interrupted_attempt(casedb::Library& library, const casedb::OpenAttempt& attempt);

}  // namespace seldinger::session
