#include "assessment/operators/wander.h"

#include <numbers>

#include "sim/base/exact_math.h"
#include "sim/base/vectors.h"

namespace seldinger::assessment {

double Wander::at(double t_s) const noexcept {
  double sum = 0.0;
  for (int i = 0; i < 3; ++i) sum += base::exact_sin(phase_rad[i] + rate_rad_s[i] * t_s);
  return sum / 1.224744871391589;  // √(3/2): unit variance
}

Wander make_wander(base::Rng& rng, double low_hz, double high_hz) {
  Wander wander;
  for (int i = 0; i < 3; ++i) {
    wander.phase_rad[i] = 2.0 * std::numbers::pi * rng.uniform();
    wander.rate_rad_s[i] = 2.0 * std::numbers::pi * (low_hz + (high_hz - low_hz) * rng.uniform());
  }
  return wander;
}

UnsteadyHand::UnsteadyHand(base::Rng& rng) {
  for (Wander& wander : tremor_) wander = make_wander(rng, kTremorLowHz, kTremorHighHz);
  for (Wander& wander : sway_) wander = make_wander(rng, kSwayLowHz, kSwayHighHz);
}

glm::dvec3 UnsteadyHand::offset_mm(double t_s, const glm::dvec3& direction, double tremor_mm, double sway_mm,
                                   bool in_tissue) const noexcept {
  const auto [u, v] = base::perpendiculars(direction);
  const glm::dvec3 tremor(tremor_[0].at(t_s), tremor_[1].at(t_s), tremor_[2].at(t_s));
  const glm::dvec3 sway = u * sway_[0].at(t_s) + v * sway_[1].at(t_s);
  return (in_tissue ? kHeldByTissue : 1.0) * (tremor_mm * tremor + sway_mm * sway);
}

}  // namespace seldinger::assessment
