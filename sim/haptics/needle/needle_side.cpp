#include "sim/haptics/needle/needle_side.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "sim/base/exact_math.h"

namespace seldinger::haptics {

double bending_stiffness_n_mm2(const cases::Gauge& gauge) noexcept {
  constexpr double kSteelNMm2 = 200e3, kPi = std::numbers::pi;
  const double outer2 = gauge.outer_mm * gauge.outer_mm, inner2 = gauge.inner_mm * gauge.inner_mm;
  return kSteelNMm2 * kPi / 64.0 * (outer2 * outer2 - inner2 * inner2);
}

double side_stiffness_n_mm(double inserted_mm, double bending_n_mm2, double foundation_n_mm2) noexcept {
  if (!(inserted_mm > 0.0)) return 0.0;
  const double lambda_per_mm = std::sqrt(std::sqrt(foundation_n_mm2 / (4.0 * bending_n_mm2)));
  const double x = lambda_per_mm * inserted_mm;
  // What follows is a difference of nearly equal numbers there; the rigid bar is off by less than 1e-6.
  if (x < 0.03) return 0.25 * foundation_n_mm2 * inserted_mm;
  if (x > 20.0) return foundation_n_mm2 / (2.0 * lambda_per_mm);
  const double up = base::exact_exp(x), down = 1.0 / up;
  const double sinh = 0.5 * (up - down), cosh = 0.5 * (up + down);
  const double sine = base::exact_sin(x), cosine = base::exact_cos(x);
  return foundation_n_mm2 / (2.0 * lambda_per_mm) * (sinh * sinh - sine * sine) / (sinh * cosh - sine * cosine);
}

NeedleSideLaw::NeedleSideLaw(const NeedleSettings& settings, const cases::Gauge& gauge)
    : most_stiffness_n_mm_(settings.stiffness_n_mm),
      bending_n_mm2_(bending_stiffness_n_mm2(gauge)),
      damper_({.tick_s = settings.tick_s,
               .damping_n_s_mm = settings.damping_n_s_mm,
               .stiffness_n_mm = settings.stiffness_n_mm}) {}

glm::dvec3 NeedleSideLaw::advance(const glm::dvec3& shift_mm, double inserted_mm,
                                  NeedleSideTrack& track) const noexcept {
  const double stiffness_n_mm =
      std::min(most_stiffness_n_mm_, side_stiffness_n_mm(inserted_mm, bending_n_mm2_, kFoundationNMm2));
  const glm::dvec3 last_n = track.elastic_n;
  // Pulled out, the share of what lets go is gone.
  if (stiffness_n_mm < track.stiffness_n_mm) track.elastic_n *= stiffness_n_mm / track.stiffness_n_mm;
  if (track.begun) track.elastic_n -= stiffness_n_mm * (shift_mm - track.last_mm);
  track.damper_n = damper_.advance(track.damper_n, track.elastic_n - last_n);
  track.stiffness_n_mm = stiffness_n_mm;
  track.last_mm = shift_mm;
  track.begun = true;
  return track.elastic_n + track.damper_n;
}

}  // namespace seldinger::haptics
