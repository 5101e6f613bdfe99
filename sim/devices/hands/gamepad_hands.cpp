#include "sim/devices/hands/gamepad_hands.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

namespace seldinger::devices {
namespace {

// GLFW_GAMEPAD_BUTTON_A, … and their actions.
enum Button : std::size_t {
  kA,
  kB,
  kX,
  kY,
  kLeftBumper,
  kRightBumper,
  kBack,
  kStart,
  kUp = 11,
  kRight,
  kDown,
  kLeft
};
constexpr std::pair<Button, HandAction> kActions[] = {
    {kA, HandAction::fire},          {kB, HandAction::guide},           {kX, HandAction::swap},
    {kY, HandAction::freeze},        {kStart, HandAction::reset},       {kUp, HandAction::slide_away},
    {kDown, HandAction::slide_near}, {kRight, HandAction::rotate_more}, {kLeft, HandAction::rotate_less}};

// A broken driver's numbers do nothing.
double share(float axis) noexcept {
  return std::isfinite(axis) ? std::clamp(static_cast<double>(axis), -1.0, 1.0) : 0.0;
}

}  // namespace

double stick_share(double deflection) noexcept {
  const double beyond = std::max(0.0, (std::abs(deflection) - kDeadZone) / (1.0 - kDeadZone));
  return std::copysign(beyond * beyond * beyond, deflection);
}

HandIntent GamepadHands::intent(const GamepadReading& pad, const HandView& view, HeldTool tool,
                                const cases::ToolPose& pose, double elapsed_s) noexcept {
  HandIntent intent;
  const std::size_t slide = left_handed_ ? 2 : 0, turn = left_handed_ ? 0 : 2;
  HeldActions actions;
  for (const auto& [button, action] : kActions) actions[static_cast<std::size_t>(action)] = pad.buttons[button];
  const bool left_bumper = pad.buttons[kLeftBumper], right_bumper = pad.buttons[kRightBumper];
  actions[static_cast<std::size_t>(HandAction::keep_tilt)] = left_handed_ ? right_bumper : left_bumper;
  actions[static_cast<std::size_t>(HandAction::fine)] = left_handed_ ? left_bumper : right_bumper;
  edges_.say(actions, intent);

  const auto stick = [&](std::size_t axis) { return stick_share(share(pad.axes[axis])); };
  intent.slide_lps_mm = (view.right * stick(slide) - view.up * stick(slide + 1)) * (kStickSlideMmS * elapsed_s);
  if (tool == HeldTool::needle)
    intent.turn_lps_rad =
        glm::cross(-pose.axis, view.right * stick(turn) - view.up * stick(turn + 1)) * (kStickTurnRadS * elapsed_s);
  else
    intent.turn_own_rad = glm::dvec3(stick(turn + 1), stick(turn), 0.0) * (kStickTurnRadS * elapsed_s);
  const double left = 0.5 * (share(pad.axes[4]) + 1.0), right = 0.5 * (share(pad.axes[5]) + 1.0);
  intent.advance_mm =
      (stick_share(right) - stick_share(left)) * (left_handed_ ? -1.0 : 1.0) * kTriggerMmS * elapsed_s;
  add_keys(actions, view, elapsed_s, intent);
  if (held(actions, HandAction::fine)) make_fine(intent);
  return intent;
}

}  // namespace seldinger::devices
