#include "assessment/metrics/endpoint.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "assessment/signals.h"

namespace seldinger::assessment {
namespace {

constexpr double kMinCoreMm = 5.0;  // assessment.md §8, hit: min_core_mm

bool core(const Signals& signals) {
  return signals.setting.instrument.kind == cases::InstrumentKind::core;
}

const char* missing(const Signals& signals) {
  if (!signals.endpoint) return "no_endpoint";
  if (!signals.setting.target) return "no_target";
  return nullptr;
}

// The sample notch after the throw: from start, along the needle, notch_mm long.
glm::dvec3 notch_start(const Signals& signals) {
  const cases::Instrument& needle = signals.setting.instrument;
  return signals.endpoint->tip_lps_mm +
         signals.endpoint->direction * (needle.throw_mm - needle.dead_tip_mm - needle.notch_mm);
}

// Length of start + s·direction, 0 ≤ s ≤ length, inside a sphere.
double length_in_sphere(const glm::dvec3& start, const glm::dvec3& direction, double length_mm,
                        const cases::Lesion& sphere) {
  const glm::dvec3 d = sphere.center_lps_mm - start;
  const double middle = glm::dot(d, direction);
  const double half2 = sphere.radius_mm * sphere.radius_mm - (glm::dot(d, d) - middle * middle);
  if (half2 <= 0.0) return 0.0;
  const double half = std::sqrt(half2);
  return std::max(0.0, std::min(middle + half, length_mm) - std::max(middle - half, 0.0));
}

// The point that counts, to the target's centre: the tip, or the middle of a core needle's notch (clinical.md).
glm::dvec3 to_target(const Signals& signals) {
  glm::dvec3 point = signals.endpoint->tip_lps_mm;
  if (core(signals))
    point = notch_start(signals) + signals.endpoint->direction * (signals.setting.instrument.notch_mm / 2);
  return signals.setting.target->center_lps_mm - point;
}

}  // namespace

Measured core_in_target(const Signals& signals) {
  if (!core(signals)) return Measured::none("not_a_core_needle");
  if (const char* reason = missing(signals)) return Measured::none(reason);
  return Measured::of(length_in_sphere(notch_start(signals), signals.endpoint->direction,
                                       signals.setting.instrument.notch_mm, *signals.setting.target));
}

Measured hit(const Signals& signals) {
  if (const char* reason = missing(signals)) return Measured::none(reason);
  if (core(signals)) return Measured::of(*core_in_target(signals).value >= kMinCoreMm ? 1.0 : 0.0);
  return Measured::of(glm::length(to_target(signals)) <= signals.setting.target->radius_mm ? 1.0 : 0.0);
}

Measured tip_target_dist(const Signals& signals) {
  if (const char* reason = missing(signals)) return Measured::none(reason);
  return Measured::of(glm::length(to_target(signals)));
}

Measured tip_target_surface(const Signals& signals) {
  if (const char* reason = missing(signals)) return Measured::none(reason);
  return Measured::of(glm::length(to_target(signals)) - signals.setting.target->radius_mm);
}

Measured tip_target_axial(const Signals& signals) {
  if (const char* reason = missing(signals)) return Measured::none(reason);
  return Measured::of(glm::dot(to_target(signals), signals.endpoint->direction));
}

Measured tip_target_lateral(const Signals& signals) {
  if (const char* reason = missing(signals)) return Measured::none(reason);
  return Measured::of(glm::length(glm::cross(to_target(signals), signals.endpoint->direction)));
}

}  // namespace seldinger::assessment
