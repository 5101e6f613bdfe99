// What a hand does that nobody asked it to: slow sway, fast tremor.
#pragma once

#include <glm/vec3.hpp>

#include "sim/base/rng.h"

namespace seldinger::assessment {

constexpr double kTremorLowHz = 8.0, kTremorHighHz = 12.0;  // physiological tremor
constexpr double kSwayLowHz = 0.1, kSwayHighHz = 0.5;
constexpr double kHeldByTissue = 0.3;  // share of the hand's sway that reaches a tip in tissue
constexpr double kTriggerHoldSeconds = 0.4;

// A wander of unit variance: three incommensurate frequencies with random phases.
struct Wander {
  double phase_rad[3] = {}, rate_rad_s[3] = {};
  double at(double t_s) const noexcept;
};

Wander make_wander(base::Rng& rng, double low_hz, double high_hz);

// The hand that holds a needle.
class UnsteadyHand {
 public:
  UnsteadyHand() = default;  // a steady one, until it is drawn
  explicit UnsteadyHand(base::Rng& rng);
  // How far the tip is from where it was meant: tremor in all directions, sway across the needle; less of both
  // where tissue holds the tip. `direction` of unit length.
  glm::dvec3 offset_mm(double t_s, const glm::dvec3& direction, double tremor_mm, double sway_mm,
                       bool in_tissue) const noexcept;

 private:
  Wander tremor_[3], sway_[2];
};

}  // namespace seldinger::assessment
