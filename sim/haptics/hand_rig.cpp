#include "sim/haptics/hand_rig.h"

#include <algorithm>
#include <cmath>

#include "sim/base/check.h"

namespace seldinger::haptics {

HandRig::HandRig(const ArmModel& device, const Hand& hand, double at_mm, double speed_mm_s, double motor_n)
    : device_(device), hand_(hand), at_mm_(at_mm), speed_mm_s_(speed_mm_s), motor_n_(motor_n) {
  line_.fill(motor_n);
  CHECK(device.mass_kg > 0.0 && device.delay_ticks >= 0 && device.delay_ticks <= kMostDelayTicks);
}

double HandRig::encoder_mm() const noexcept {
  return device_.encoder_mm > 0.0 ? std::round(at_mm_ / device_.encoder_mm) * device_.encoder_mm : at_mm_;
}

void HandRig::hold(double force_n, const HandWill& will) noexcept {
  std::copy_backward(line_.begin(), line_.end() - 1, line_.end());
  line_[0] = force_n;
  motor_n_ = std::clamp(line_[static_cast<std::size_t>(device_.delay_ticks)], -device_.peak_n, device_.peak_n);
  constexpr int kSteps = 100;
  static_assert(kSteps * kBenchStepS == kTickS);
  // 1 N on 1 kg is 1000 mm/s².
  const double per_n = 1000.0 * kBenchStepS / (device_.mass_kg + hand_.mass_kg);
  const double most_friction_mm_s = device_.coulomb_n * per_n;
  for (int i = 0; i < kSteps; ++i) {
    const double grip_mm = will.at_mm + will.speed_mm_s * kBenchStepS * i;
    const double free_n = will.push_n - motor_n_ + hand_.stiffness_n_mm * (grip_mm - at_mm_) +
                          hand_.damping_n_s_mm * (will.speed_mm_s - speed_mm_s_) -
                          device_.damping_n_s_mm * speed_mm_s_;
    const double free_mm_s = speed_mm_s_ + per_n * free_n;
    // Dry friction takes what it can, and holds at rest: time stepping after Moreau (1988).
    speed_mm_s_ = free_mm_s - std::clamp(free_mm_s, -most_friction_mm_s, most_friction_mm_s);
    const double moved_mm = speed_mm_s_ * kBenchStepS;
    at_mm_ += moved_mm;
    work_mj_ += motor_n_ * moved_mm;
  }
}

}  // namespace seldinger::haptics
