#include "assessment/operators/wander.h"

#include <numbers>

#include "sim/base/vectors.h"

namespace seldinger::assessment {

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
  const auto at = wanders_at<5>({&tremor_[0], &tremor_[1], &tremor_[2], &sway_[0], &sway_[1]}, t_s);
  const glm::dvec3 tremor(at[0], at[1], at[2]);
  const glm::dvec3 sway = u * at[3] + v * at[4];
  return (in_tissue ? kHeldByTissue : 1.0) * (tremor_mm * tremor + sway_mm * sway);
}

}  // namespace seldinger::assessment
