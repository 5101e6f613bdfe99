// What a hand wants of the tool it holds, whatever it speaks through: mouse and keys, gamepad, 3-D mouse. All but
// the levels are amounts since the last, or how often a button went down: intents add up, so a window's running sum
// can be read by a servo at its own pace (`since`) without losing a notch.
#pragma once

#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace seldinger::devices {

enum class HeldTool { needle, probe };

struct HandIntent {
  glm::dvec3 slide_lps_mm{0.0};
  glm::dvec3 turn_lps_rad{0.0};  // rotation vectors, right-handed: in space,
  glm::dvec3 turn_own_rad{0.0};  // and about the tool's side (tilt), axis × side (rock) and axis (rotate)
  double advance_mm = 0.0;       // along its axis: the needle forwards, the probe into the skin
  std::uint32_t swaps = 0, freezes = 0, guides = 0, resets = 0;
  // Levels, as they are now.
  bool fire = false;
  bool keep_tilt = false;  // the probe does not follow the skin's normal
  bool in_space = false;   // what of a slide is along the tool's axis advances it where it cannot slide
};

inline void add(const HandIntent& more, HandIntent& sum) noexcept {
  const HandIntent before = sum;
  sum = more;
  sum.slide_lps_mm += before.slide_lps_mm;
  sum.turn_lps_rad += before.turn_lps_rad;
  sum.turn_own_rad += before.turn_own_rad;
  sum.advance_mm += before.advance_mm;
  sum.swaps += before.swaps;
  sum.freezes += before.freezes;
  sum.guides += before.guides;
  sum.resets += before.resets;
}

// Devices that one hand uses at once: a level holds where any has it up, and whose slide is longer says how it is
// meant.
inline void join(const HandIntent& other, HandIntent& one) noexcept {
  HandIntent both = one;
  both.fire = one.fire || other.fire;
  both.keep_tilt = one.keep_tilt || other.keep_tilt;
  if (glm::dot(other.slide_lps_mm, other.slide_lps_mm) > glm::dot(one.slide_lps_mm, one.slide_lps_mm))
    both.in_space = other.in_space;
  const HandIntent levels = both;
  add(other, both);
  both.fire = levels.fire;
  both.keep_tilt = levels.keep_tilt;
  both.in_space = levels.in_space;
  one = both;
}

// How much it moves a tool, to compare hands by: mm, and a radian as much as 100 mm, about the way from a tool's
// tip to the hand.
inline double way_of(const HandIntent& intent) noexcept {
  constexpr double kMmPerRad = 100.0;
  return glm::length(intent.slide_lps_mm) + std::abs(intent.advance_mm) +
         kMmPerRad * (glm::length(intent.turn_lps_rad) + glm::length(intent.turn_own_rad));
}

// What came between two readings of one running sum.
inline HandIntent since(const HandIntent& before, HandIntent sum) noexcept {
  sum.slide_lps_mm -= before.slide_lps_mm;
  sum.turn_lps_rad -= before.turn_lps_rad;
  sum.turn_own_rad -= before.turn_own_rad;
  sum.advance_mm -= before.advance_mm;
  sum.swaps -= before.swaps;
  sum.freezes -= before.freezes;
  sum.guides -= before.guides;
  sum.resets -= before.resets;
  return sum;
}

}  // namespace seldinger::devices
