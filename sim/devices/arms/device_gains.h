// What a user sets of an arm: how far its tool goes for a way of the hand, how hard it pushes, and its most force.
#pragma once

#include <algorithm>
#include <cmath>

namespace seldinger::devices {

struct DeviceGains {
  double motion_scale = 1.0;   // mm of the patient for a mm of the hand
  double force_share = 1.0;    // of what the patient's tissue asks for
  double most_force_n = 10.0;  // of the motors (as sim/haptics has it for an Inverse3: design)

  bool operator==(const DeviceGains&) const = default;
};

// Design: beyond these a puncture is no longer one. A force of nothing is a choice: the motors are off.
inline constexpr double kLeastMotionScale = 0.5, kMostMotionScale = 2.0;
inline constexpr double kMostForceShare = 1.0, kMostForceN = 10.0;

inline bool is_sound(const DeviceGains& gains) noexcept {
  return gains.motion_scale >= kLeastMotionScale && gains.motion_scale <= kMostMotionScale &&
         gains.force_share >= 0.0 && gains.force_share <= kMostForceShare && gains.most_force_n >= 0.0 &&
         gains.most_force_n <= kMostForceN;
}

// Of the force that tissue asks for, what may go to the motors when a mm of the hand is scale mm of the patient:
// the hand feels share · scale times the tissue's stiffness, and more than that itself would not come to rest
// (closed form: with forces 1:1 the device shows s · K).
inline double usable_share(const DeviceGains& gains, double scale) noexcept {
  return std::min(gains.force_share, scale > 1.0 ? 1.0 / scale : 1.0);
}

}  // namespace seldinger::devices
