// A haptic arm without hardware: follows the hand with a lag and a speed limit and reads its pose through an
// encoder.
#pragma once

#include "sim/case/inputs.h"

namespace seldinger::devices {

struct VirtualDeviceOptions {
  double lag_s = 0.02;            // first-order lag of hand and arm
  double max_speed_mm_s = 400.0;  // what a hand does with a needle; keeps a jump of the plan from being one
  double encoder_mm =
      1.0 / 32.0;  // reading step; Phantom Omni's nominal 0.055 mm is 2 of these, Premium's 0.03 is 1
  double encoder_unit = 1.0 / 8192.0;  // reading step of axis components: 0.007°
};

class VirtualDevice {
 public:
  explicit VirtualDevice(const VirtualDeviceOptions& options = {}) : options_(options) {}

  // The arm's reading after dt_s of the hand wanting `hand`. The first call stands where the hand is.
  cases::ToolPose advance(const cases::ToolPose& hand, double dt_s) noexcept;
  // Of an arm that is there, which has lag enough of its own: where it was read to be, through this encoder; a hand
  // goes on from there.
  cases::ToolPose follow(const cases::ToolPose& read) noexcept;

 private:
  VirtualDeviceOptions options_;
  cases::ToolPose pose_;
  bool started_ = false;
};

}  // namespace seldinger::devices
