// Mouse and keys as a hand. Dragging with the primary button slides the held tool in the screen's plane; with the
// secondary it turns: the needle's hub goes with the mouse, the probe tilts and rocks; with the middle one it
// rotates about its axis. The wheel advances along the axis. Keys do all of it as well, at fixed speeds.
// Pure: the window says what came since its last frame.
#pragma once

#include <bitset>
#include <cstdint>
#include <glm/vec3.hpp>

#include "sim/case/inputs.h"
#include "sim/devices/hands/hand_intent.h"

namespace seldinger::devices {

// What a held key, or a gamepad's button, stands for; which key it is, is the window's to say.
enum class HandAction : std::uint8_t {
  fine,
  keep_tilt,
  fire,
  swap,
  freeze,
  guide,
  reset,  // these act when they go down
  slide_right,
  slide_left,
  slide_up,
  slide_down,
  slide_away,
  slide_near,
  advance,
  withdraw,
  tilt_more,
  tilt_less,
  rock_more,
  rock_less,
  rotate_more,
  rotate_less,
};
inline constexpr std::size_t kHandActions = 21;
using HeldActions = std::bitset<kHandActions>;
inline bool held(const HeldActions& actions, HandAction action) noexcept {
  return actions[static_cast<std::size_t>(action)];
}

struct MouseEvents {
  double right_px = 0.0, down_px = 0.0;  // moved since the last
  double wheel_notches = 0.0;            // > 0: away from the hand, which advances
  bool primary = false, secondary = false, middle = false;
  HeldActions actions;
  double elapsed_s = 0.0;
};

// The camera: unit vectors in LPS, perpendicular, and what a pixel is at the tool.
struct HandView {
  glm::dvec3 right{1.0, 0.0, 0.0}, up{0.0, 0.0, 1.0}, away{0.0, 1.0, 0.0};
  double mm_per_pixel = 0.5;
};

// Design: a slow notch is a step that an eye follows on the picture, a spun wheel gets through 100 mm in a second.
inline constexpr double kSlowNotchMm = 0.5, kFastNotchMm = 4.0;
inline constexpr double kSlowNotchesS = 10.0, kFastNotchesS = 24.0;  // between these it grows evenly
inline constexpr double kWheelMemoryS = 0.15;                        // over which notches/s are told
double notch_mm(double notches_per_s) noexcept;

inline constexpr double kRadPerPixel = 0.004363323129985824;                                            // 0.25°
inline constexpr double kKeySlideMmS = 40.0, kKeyAdvanceMmS = 15.0, kKeyTurnRadS = 0.5235987755982988;  // 30°/s
inline constexpr double kFine = 0.1;

// Counts how often the acting buttons went down, whichever device has them.
class ActionEdges {
 public:
  void say(const HeldActions& actions, HandIntent& intent) noexcept;

 private:
  HeldActions last_;
};

// What the held actions slide, advance and turn in elapsed_s, before `fine`.
void add_keys(const HeldActions& actions, const HandView& view, double elapsed_s, HandIntent& intent) noexcept;
void make_fine(HandIntent& intent) noexcept;

class MouseHands {
 public:
  // left_handed: primary and secondary button change places.
  explicit MouseHands(bool left_handed = false) : left_handed_(left_handed) {}

  HandIntent intent(const MouseEvents& events, const HandView& view, HeldTool tool,
                    const cases::ToolPose& pose) noexcept;

 private:
  bool left_handed_;
  double notches_per_s_ = 0.0;
  ActionEdges edges_;
};

}  // namespace seldinger::devices
