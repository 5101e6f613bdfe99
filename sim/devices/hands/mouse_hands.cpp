#include "sim/devices/hands/mouse_hands.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace seldinger::devices {
namespace {

// 1, −1 or 0.
double way(const HeldActions& actions, HandAction more, HandAction less) noexcept {
  return (held(actions, more) ? 1.0 : 0.0) - (held(actions, less) ? 1.0 : 0.0);
}

}  // namespace

double notch_mm(double notches_per_s) noexcept {
  const double share = (notches_per_s - kSlowNotchesS) / (kFastNotchesS - kSlowNotchesS);
  return kSlowNotchMm + (kFastNotchMm - kSlowNotchMm) * std::clamp(share, 0.0, 1.0);
}

void ActionEdges::say(const HeldActions& actions, HandIntent& intent) noexcept {
  const auto went_down = [&](HandAction action) { return held(actions, action) && !held(last_, action) ? 1U : 0U; };
  intent.swaps = went_down(HandAction::swap);
  intent.freezes = went_down(HandAction::freeze);
  intent.guides = went_down(HandAction::guide);
  intent.resets = went_down(HandAction::reset);
  intent.fire = held(actions, HandAction::fire);
  intent.keep_tilt = held(actions, HandAction::keep_tilt);
  last_ = actions;
}

void add_keys(const HeldActions& actions, const HandView& view, double elapsed_s, HandIntent& intent) noexcept {
  using A = HandAction;
  intent.slide_lps_mm += (view.right * way(actions, A::slide_right, A::slide_left) +
                          view.up * way(actions, A::slide_up, A::slide_down) +
                          view.away * way(actions, A::slide_away, A::slide_near)) *
                         (kKeySlideMmS * elapsed_s);
  intent.advance_mm += way(actions, A::advance, A::withdraw) * kKeyAdvanceMmS * elapsed_s;
  intent.turn_own_rad +=
      glm::dvec3(way(actions, A::tilt_more, A::tilt_less), way(actions, A::rock_more, A::rock_less),
                 way(actions, A::rotate_more, A::rotate_less)) *
      (kKeyTurnRadS * elapsed_s);
}

void make_fine(HandIntent& intent) noexcept {
  intent.slide_lps_mm *= kFine;
  intent.turn_lps_rad *= kFine;
  intent.turn_own_rad *= kFine;
  intent.advance_mm *= kFine;
}

HandIntent MouseHands::intent(const MouseEvents& events, const HandView& view, HeldTool tool,
                              const cases::ToolPose& pose) noexcept {
  HandIntent intent;
  edges_.say(events.actions, intent);
  const glm::dvec3 drag_mm = (view.right * events.right_px - view.up * events.down_px) * view.mm_per_pixel;
  const bool slides = left_handed_ ? events.secondary : events.primary;
  const bool turns = left_handed_ ? events.primary : events.secondary;
  if (slides) intent.slide_lps_mm = drag_mm;
  if (turns && tool == HeldTool::needle) {
    // The hub, on the axis behind the tip, goes where the mouse goes.
    const glm::dvec3 drag_rad = (view.right * events.right_px - view.up * events.down_px) * kRadPerPixel;
    intent.turn_lps_rad = glm::cross(-pose.axis, drag_rad);
  }
  if (turns && tool == HeldTool::probe)
    intent.turn_own_rad = glm::dvec3(events.down_px, events.right_px, 0.0) * kRadPerPixel;
  if (events.middle) intent.turn_own_rad.z = events.right_px * kRadPerPixel;
  if (events.elapsed_s > 0.0) {
    // A wheel that stood still is slow at its first notch: the mean over the memory, not over this frame; and of a
    // frame longer than that, as if its notches had come evenly: a window that lags makes nobody fast.
    const double keep = std::exp(-events.elapsed_s / kWheelMemoryS);
    notches_per_s_ = notches_per_s_ * keep + (1.0 - keep) * std::abs(events.wheel_notches) / events.elapsed_s;
  }
  intent.advance_mm = events.wheel_notches * notch_mm(notches_per_s_);
  add_keys(events.actions, view, events.elapsed_s, intent);
  if (held(events.actions, HandAction::fine)) make_fine(intent);
  return intent;
}

}  // namespace seldinger::devices
