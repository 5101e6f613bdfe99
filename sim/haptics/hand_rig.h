// The rig: a hand on a device along one axis, in steps of 10 µs of virtual time, asked for a
// force every tick (docs/touch.md). One mass, viscous and dry friction, a quantised encoder, motors with a limit,
// a delay of whole ticks. Deterministic; no clock.
#pragma once

#include <array>

#include "sim/haptics/arm_model.h"

namespace seldinger::haptics {

inline constexpr double kBenchStepS = 1e-5;

// What the hand wants during a tick.
struct HandWill {
  double at_mm = 0.0,
         speed_mm_s = 0.0;  // where its grip rests at the tick's start; ignored by a hand of stiffness 0
  double push_n = 0.0;      // a force beside its grip's spring, > 0 inwards
};

class HandRig {
 public:
  // Device's mass > 0, delay 0 to kMostDelayTicks (CHECKed). motor_n: what is in the delay line already.
  HandRig(const ArmModel& device, const Hand& hand, double at_mm, double speed_mm_s, double motor_n = 0.0);

  double encoder_mm() const noexcept;
  // One tick: the law's answer to the encoder goes into the delay line; the motors hold what comes out of it.
  void hold(double force_n, const HandWill& will) noexcept;

  double at_mm() const noexcept { return at_mm_; }
  double speed_mm_s() const noexcept { return speed_mm_s_; }
  double motor_n() const noexcept { return motor_n_; }  // > 0 pushes outwards
  // What device and hand have put into the motors so far, mJ: a passive law never gives more than it got.
  double work_mj() const noexcept { return work_mj_; }

 private:
  ArmModel device_;
  Hand hand_;
  double at_mm_, speed_mm_s_, motor_n_ = 0.0, work_mj_ = 0.0;
  std::array<double, kMostDelayTicks + 1> line_{};
};

}  // namespace seldinger::haptics
