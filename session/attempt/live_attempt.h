// An attempt in real time. The servo's thread asks the hands, steps, and hands what happened to the recorder; this
// thread tells what each picture shows, and exposes what a fluoroscope's pulses do; the recorder's thread stores.
// They meet in snapshots and one queue, so that neither picture nor disk ever keeps the servo waiting.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "assessment/fault_moments.h"
#include "assessment/plan_comparison.h"
#include "casedb/attempts/attempts.h"
#include "casedb/cases/cases.h"
#include "session/attempt/interrupted_attempt.h"
#include "session/case/program.h"
#include "sim/base/snapshot.h"
#include "sim/engine/tick.h"

namespace seldinger::session {

// A person who has not finished by then is gone.
constexpr double kMostLiveSeconds = 1800.0;

struct StoredAttempt {
  std::string attempt_id;  // empty: it was not kept
  std::vector<assessment::MetricValue> metrics;
  std::vector<assessment::StepResult> steps{};
  casedb::AttemptEnd end = casedb::AttemptEnd::stopped;
  casedb::Conditions conditions{};
  std::vector<assessment::FaultMoment> faults{};  // told with the debrief, and not kept; as the next
  std::optional<assessment::DonePath> path{};     // how the needle went in; nothing: it never did
};

class LiveAttempt {
 public:
  // By the servo: what the hands want now; `frame` is a picture that appeared since the last tick.
  using Hands = std::function<cases::Inputs(const cases::State&, const cases::FrameTruth* frame)>;

  // Who takes part. All but `opened`, `ended` and `conditions` are asked by the servo: they must not allocate, lock
  // or wait.
  struct With {
    Hands hands;
    std::function<void(const std::string& attempt_id)> opened{};  // before the first tick, by the caller's thread
    std::function<engine::ToolsRead()> read{};                    // after `hands`: what of them an arm said
    // After these: what the recorder is to note of the tick (cases::EventInfo::noted); `none`: nothing. Pauses are
    // noted without.
    std::function<cases::EventKind(const cases::State&)> note{};
    std::function<void(const engine::Tick&, const engine::TickState&)> feel{};  // after each: what hands feel in it
    std::function<bool()> done;                                                 // after each tick
    std::function<bool()> paused{};                                             // while it says so, no time goes by
    std::function<void()> stalled{};  // nor did it, as the machine stood still: before the tick that follows
    std::function<void(const engine::Moment&)> watch{};  // what else there is to do with a tick
    std::function<void()> ended{};                       // no tick comes any more; scoring and storing follow
    // By the recorder's thread, with each piece that is stored: what a mentor who looks in lets happen.
    std::function<void(cases::EventKind)> asked{};
    // The conditions that are known by now: by the recorder's thread with each piece that is stored, so that a
    // program that dies leaves what was known, and by the caller's before the first tick and after `ended`.
    std::function<casedb::Conditions()> conditions{};
  };

  // Not kept: nothing of it comes into the library; a mentor tries a draft, which stays one that can be changed.
  enum class Keep { stored, not_kept };

  // The library and the scene (with what its modality needs) must outlive it.
  LiveAttempt(casedb::Library& library, Program program, casedb::AttemptHead head, const cases::Case& scene,
              Keep keep = Keep::stored);
  // Goes on with one that was interrupted, replayed in this scene: its recording goes on, too, and says so.
  LiveAttempt(casedb::Library& library, Program program, InterruptedAttempt interrupted, const cases::Case& scene);

  const casedb::AttemptHead& head() const noexcept { return head_; }

  // Until `done` says so, kMostLiveSeconds are over, or it cannot be recorded any more. Stored, scored and durable
  // when it returns. Refused as casedb::open_attempt and close_attempt.
  base::Result<StoredAttempt> run(const With& with);

 private:
  casedb::Library& library_;
  Program program_;
  casedb::AttemptHead head_;
  const cases::Case& scene_;
  Keep keep_;
  std::optional<InterruptedAttempt> before_;  // what is resumed
};

}  // namespace seldinger::session
