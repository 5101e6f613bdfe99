// What a hand does that nobody asked it to: slow sway, fast tremor.
#pragma once

#include <array>
#include <cstddef>
#include <glm/vec3.hpp>

#include "sim/base/exact_sines.h"
#include "sim/base/rng.h"

namespace seldinger::assessment {

constexpr double kTremorLowHz = 8.0, kTremorHighHz = 12.0;  // physiological tremor
constexpr double kSwayLowHz = 0.1, kSwayHighHz = 0.5;
constexpr double kHeldByTissue = 0.3;  // share of the hand's sway that reaches a tip in tissue
constexpr double kTriggerHoldSeconds = 0.4;

// A wander of unit variance: three incommensurate frequencies with random phases.
struct Wander {
  double phase_rad[3] = {}, rate_rad_s[3] = {};
  static double of_sines(double a, double b, double c) noexcept {
    return (a + b + c) / 1.224744871391589;  // √(3/2): unit variance
  }
};

// Of several at once, which is quicker.
template <std::size_t N>
std::array<double, N> wanders_at(const std::array<const Wander*, N>& wanders, double t_s) noexcept {
  std::array<double, 3 * N> phases_rad, sines;
  for (std::size_t w = 0; w < N; ++w)
    for (std::size_t i = 0; i < 3; ++i)
      phases_rad[3 * w + i] = wanders[w]->phase_rad[i] + wanders[w]->rate_rad_s[i] * t_s;
  base::exact_sines(phases_rad, sines);
  std::array<double, N> at;
  for (std::size_t w = 0; w < N; ++w) at[w] = Wander::of_sines(sines[3 * w], sines[3 * w + 1], sines[3 * w + 2]);
  return at;
}

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
