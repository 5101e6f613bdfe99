// A simulated trainee: sees snapshots and pictures, late, and says where the hands want to be. Deterministic: the
// same plan, profile and seed act the same on every machine.
#pragma once

#include <cstdint>
#include <deque>

#include "assessment/operators/plan.h"
#include "assessment/operators/profile.h"
#include "assessment/operators/wander.h"
#include "sim/base/rng.h"
#include "sim/case/case.h"
#include "sim/case/inputs.h"
#include "sim/case/recording.h"
#include "sim/case/state.h"

namespace seldinger::assessment {

class ScriptedOperator {
 public:
  ScriptedOperator(const OperatorProfile& profile, const PuncturePlan& plan, const cases::Instrument& instrument,
                   std::uint64_t seed);

  // What the hands want in this tick. `frame` is the picture that appeared in it, if one did.
  cases::Inputs act(const cases::State& state, const cases::FrameTruth* frame, double dt_s);

  bool done() const noexcept { return phase_ == Phase::done; }

 private:
  enum class Phase { scan, approach, advance, look, withdraw, fire, done };

  void aim();
  bool tip_seen() const noexcept;
  void decide(const cases::State& state);
  void move(const cases::State& state, double dt_s);
  double goal_mm() const noexcept;

  OperatorProfile profile_;
  PuncturePlan plan_;
  double stop_short_mm_ = 0.0;  // core: the throw carries the notch the rest of the way
  base::Rng rng_;
  Phase phase_ = Phase::scan;
  double t_s_ = 0.0, phase_since_s_ = 0.0, scan_s_ = 0.0;
  glm::dvec3 believed_target_{0.0}, entry_{0.0}, direction_{0.0};
  double inserted_mm_ = 0.0;  // the hand's: from the entry along the direction, negative outside
  double withdraw_to_mm_ = 0.0;
  int redirections_ = 0;
  bool going_blind_ = false, decided_blind_ = false;
  double lost_since_s_ = 0.0;
  double alignment_ = 1.0;  // share of the probe's drift not yet corrected
  double follow_mm_ = 0.0;  // the probe's way out of the planned plane, after the tip
  UnsteadyHand hand_;
  Wander drift_, tilt_;
  std::deque<cases::FrameTruth> seen_;  // pictures younger than the reaction delay, and the one acted upon
};

}  // namespace seldinger::assessment
