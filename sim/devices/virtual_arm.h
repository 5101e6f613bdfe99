// A haptic arm without hardware: follows the hand with a lag and a speed limit and reads its pose through an
// encoder.
#pragma once

#include "sim/case/inputs.h"

namespace seldinger::devices {

struct VirtualArmOptions {
  double lag_s = 0.02;            // first-order lag of hand and arm
  double max_speed_mm_s = 400.0;  // what a hand does with a needle; keeps a jump of the plan from being one
  double encoder_mm =
      1.0 / 32.0;  // reading step; Phantom Omni's nominal 0.055 mm is 2 of these, Premium's 0.03 is 1
  double encoder_unit = 1.0 / 8192.0;  // reading step of axis components: 0.007°
};

// What must be kept from reading to reading. A new one stands where the hand is first.
struct VirtualDeviceState {
  cases::ToolPose pose;
  bool started = false;
};

// The arm's reading after dt_s of the hand wanting `hand`.
cases::ToolPose advance(const cases::ToolPose& hand, double dt_s, VirtualDeviceState& state,
                        const VirtualArmOptions& options = {}) noexcept;
// Of an arm that is there, which has lag enough of its own: where it was read to be, through this encoder; a hand
// goes on from there.
cases::ToolPose follow(const cases::ToolPose& read, VirtualDeviceState& state,
                       const VirtualArmOptions& options = {}) noexcept;

// The same as one object.
class VirtualArm {
 public:
  explicit VirtualArm(const VirtualArmOptions& options = {}) : options_(options) {}
  cases::ToolPose advance(const cases::ToolPose& hand, double dt_s) noexcept {
    return devices::advance(hand, dt_s, state_, options_);
  }
  cases::ToolPose follow(const cases::ToolPose& read) noexcept { return devices::follow(read, state_, options_); }

 private:
  VirtualArmOptions options_;
  VirtualDeviceState state_;
};

}  // namespace seldinger::devices
