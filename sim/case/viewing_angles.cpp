#include "sim/case/viewing_angles.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "sim/base/exact_math.h"
#include "sim/case/c_arm.h"

namespace seldinger::cases {

void add_view(double lao_deg, double cranial_deg, ViewingAngles& views) noexcept {
  const glm::dvec3 here = beam_direction(lao_deg, cranial_deg, PatientPosition::supine);
  bool distinct = true;
  for (int i = 0; i < views.count; ++i) {
    const auto at = static_cast<std::size_t>(i);
    const glm::dvec3 there = beam_direction(views.lao_deg[at], views.cranial_deg[at], PatientPosition::supine);
    // arctan of sine over cosine: arccos would lose half the digits of small angles.
    const double sine = glm::length(glm::cross(here, there)), cosine = std::abs(glm::dot(here, there));
    const double apart_deg = cosine > 0.0 ? base::exact_atan(sine / cosine) * (180.0 / std::numbers::pi) : 90.0;
    views.widest_deg = std::max(views.widest_deg, apart_deg);
    distinct = distinct && apart_deg >= kViewApartDeg;
  }
  if (!distinct || views.count == kMaxViews) return;
  const auto at = static_cast<std::size_t>(views.count++);
  views.lao_deg[at] = lao_deg;
  views.cranial_deg[at] = cranial_deg;
}

}  // namespace seldinger::cases
