#include "app/measure/rigs/wall.h"

#include <algorithm>
#include <numbers>

#include "sim/base/exact_math.h"
#include "sim/haptics/hand_rig.h"

namespace seldinger::measure {

Wall::Wall(double stiffness_n_mm, double damping_n_s_mm, double cutoff_hz)
    : stiffness_n_mm_(stiffness_n_mm), damping_n_s_mm_(damping_n_s_mm) {
  constexpr double kTwoPi = 2.0 * std::numbers::pi;
  share_ = cutoff_hz > 0.0 ? 1.0 - base::exact_exp(-kTwoPi * cutoff_hz * haptics::kTickS) : 1.0;
}

double Wall::advance(double depth_mm) noexcept {
  const double speed_mm_s = begun_ ? (depth_mm - last_mm_) / haptics::kTickS : 0.0;
  speed_mm_s_ += share_ * (speed_mm_s - speed_mm_s_);
  last_mm_ = depth_mm;
  begun_ = true;
  if (!(depth_mm > 0.0)) return 0.0;
  return std::max(0.0, stiffness_n_mm_ * depth_mm + damping_n_s_mm_ * speed_mm_s_);
}

}  // namespace seldinger::measure
