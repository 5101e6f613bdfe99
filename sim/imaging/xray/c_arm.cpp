#include "sim/imaging/xray/c_arm.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "sim/base/check.h"

namespace seldinger::imaging {

XrayGeometry c_arm_geometry(const cases::Fluoroscope& fluoroscope, const cases::CArm& arm, int magnification,
                            int size_px, cases::PatientPosition position) {
  CHECK(size_px > 0);
  const cases::BeamFrame frame = cases::beam_frame(fluoroscope, arm, position);
  XrayGeometry geometry;
  geometry.source_lps_mm = frame.source_lps_mm;
  geometry.direction = frame.direction;
  geometry.detector_center_lps_mm = frame.detector_center_lps_mm;
  geometry.u = frame.u;
  geometry.v = frame.v;
  geometry.pixel_mm = cases::field_side_mm(fluoroscope, magnification) / size_px;
  geometry.width_px = geometry.height_px = size_px;
  return geometry;
}

glm::dvec3 hand_at_needle(const glm::dvec3& tip_lps_mm, const glm::dvec3& direction, double length_mm) noexcept {
  return tip_lps_mm - direction * (length_mm * kHandShare);
}

bool meets_beam(const cases::BeamFrame& frame, double field_side_mm, const cases::Collimator& collimator,
                const glm::dvec3& center_lps_mm, double radius_mm) noexcept {
  // In the beam's own axes, by symmetry in one quarter of it. The cross-section at a share s of the way to the
  // detector is a rectangle of half sides s·a, s·b, so the squared distance to it is
  //   (s·L − z)² + max(0, x − s·a)² + max(0, y − s·b)²,
  // convex in s and a parabola for each choice of which of the two sides are beyond. Its minimum is at one of their
  // vertices, where one of them begins, or at an end.
  const glm::dvec3 way = center_lps_mm - frame.source_lps_mm;
  const double x = std::abs(glm::dot(way, frame.u)), y = std::abs(glm::dot(way, frame.v));
  const double z = glm::dot(way, frame.direction), length = frame.sid_mm;
  const double a = field_side_mm / 2.0 * collimator.open_u, b = field_side_mm / 2.0 * collimator.open_v;
  const auto distance2 = [&](double s) {
    const double t = std::clamp(s, 0.0, 1.0);
    const double along = t * length - z, beyond_x = std::max(0.0, x - t * a), beyond_y = std::max(0.0, y - t * b);
    return along * along + beyond_x * beyond_x + beyond_y * beyond_y;
  };
  double nearest2 = std::min({distance2(0.0), distance2(1.0), distance2(x / a), distance2(y / b)});
  for (const double with_x : {0.0, 1.0})
    for (const double with_y : {0.0, 1.0})
      nearest2 = std::min(nearest2, distance2((z * length + with_x * a * x + with_y * b * y) /
                                              (length * length + with_x * a * a + with_y * b * b)));
  return nearest2 <= radius_mm * radius_mm;
}

}  // namespace seldinger::imaging
