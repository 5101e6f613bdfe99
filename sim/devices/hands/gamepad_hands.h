// A gamepad as a hand. Left stick: slides in the screen's plane; right stick: turns the tool about the screen's
// axes (the needle's hub goes with it; a probe tilts and rocks); triggers: advance (right) and withdraw (left);
// D-pad: away and near, rotate; left bumper keeps the probe's tilt, right one is fine; A fires, B takes the guide,
// X changes the tool, Y freezes, Start goes back to the start. Pure: axes and buttons are the window's to read.
#pragma once

#include <array>

#include "sim/devices/hands/mouse_hands.h"

namespace seldinger::devices {

// In the order of GLFW's gamepad mapping (its documentation, "Gamepad input"): sticks −1 … 1, right and down;
// triggers −1 … 1, pressed.
struct GamepadReading {
  static constexpr std::size_t kAxes = 6, kButtons = 15;
  std::array<float, kAxes> axes{0.0F, 0.0F, 0.0F, 0.0F, -1.0F, -1.0F};
  std::array<bool, kButtons> buttons{};
};

// At full deflection (design); a stick that does not come back to the middle exactly is at rest below the dead
// zone, and grows from there with the cube, so that the middle is fine.
inline constexpr double kStickSlideMmS = 100.0, kStickTurnRadS = 1.0, kTriggerMmS = 40.0, kDeadZone = 0.12;
double stick_share(double deflection) noexcept;

class GamepadHands {
 public:
  // left_handed: the sticks, the triggers and the bumpers change places.
  explicit GamepadHands(bool left_handed = false) : left_handed_(left_handed) {}

  HandIntent intent(const GamepadReading& pad, const HandView& view, HeldTool tool, const cases::ToolPose& pose,
                    double elapsed_s) noexcept;

 private:
  bool left_handed_;
  ActionEdges edges_;
};

}  // namespace seldinger::devices
