#include "sim/case/c_arm.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "sim/base/exact_math.h"

namespace seldinger::cases {
namespace {

constexpr double kRadPerDeg = std::numbers::pi / 180.0;

// At 0° the rays run up from under the table. LAO turns them to the patient's left, whether he is supine or prone.
// Of one on his side it keeps to the machine: where a supine patient has his left, he has his front when he was
// rolled onto his left side, and his back on his right.
struct Turned {
  glm::dvec3 ahead, aside;  // at 0°, and at 90° LAO
};
Turned turned(PatientPosition position) noexcept {
  switch (position) {
    case PatientPosition::prone:  // what the machine calls left is his right, so LAO is the other way round for it
      return {upwards(position), {1.0, 0.0, 0.0}};
    case PatientPosition::lateral_left:
      return {upwards(position), {0.0, -1.0, 0.0}};
    case PatientPosition::lateral_right:
      return {upwards(position), {0.0, 1.0, 0.0}};
    case PatientPosition::supine:
      break;
  }
  return {upwards(position), {1.0, 0.0, 0.0}};
}

}  // namespace

glm::dvec3 beam_direction(double lao_deg, double cranial_deg, PatientPosition position) noexcept {
  const double lao = lao_deg * kRadPerDeg, cranial = cranial_deg * kRadPerDeg;
  const double level = base::exact_cos(cranial), up = base::exact_cos(lao) * level,
               out = base::exact_sin(lao) * level;
  const Turned axes = turned(position);
  glm::dvec3 direction = axes.ahead * up + axes.aside * out;
  direction.z = base::exact_sin(cranial);
  return direction;
}

BeamAngles angles_of_beam(const glm::dvec3& direction, PatientPosition position) noexcept {
  const Turned axes = turned(position);
  const double ahead = axes.ahead.x * direction.x + axes.ahead.y * direction.y;
  const double aside = axes.aside.x * direction.x + axes.aside.y * direction.y;
  const double level = std::sqrt(direction.x * direction.x + direction.y * direction.y);
  BeamAngles angles;
  if (ahead > 0.0)
    angles.lao_deg = base::exact_atan(aside / ahead) / kRadPerDeg;
  else if (ahead < 0.0)
    angles.lao_deg = base::exact_atan(aside / ahead) / kRadPerDeg + (aside < 0.0 ? -180.0 : 180.0);
  else if (aside != 0.0)
    angles.lao_deg = aside > 0.0 ? 90.0 : -90.0;
  if (level > 0.0)
    angles.cranial_deg = base::exact_atan(direction.z / level) / kRadPerDeg;
  else
    angles.cranial_deg = direction.z < 0.0 ? -90.0 : 90.0;
  return angles;
}

BeamFrame beam_frame(const Fluoroscope& fluoroscope, const CArm& arm, PatientPosition position) noexcept {
  BeamFrame frame;
  frame.direction = beam_direction(arm.lao_deg, arm.cranial_deg, position);
  // Level, and to the right of somebody who looks from the detector with the head up.
  const glm::dvec3 level = beam_direction(arm.lao_deg, 0.0, position);
  frame.u = {-level.y, level.x, 0.0};
  frame.v = glm::cross(frame.u, frame.direction);
  frame.sid_mm = arm.sid_mm;
  frame.source_lps_mm = arm.isocentre_lps_mm - frame.direction * fluoroscope.source_isocentre_mm;
  frame.detector_center_lps_mm = frame.source_lps_mm + frame.direction * arm.sid_mm;
  return frame;
}

double field_side_mm(const Fluoroscope& fluoroscope, int magnification) noexcept {
  return fluoroscope.field_side_mm[static_cast<std::size_t>(std::clamp(magnification, 0, 2))];
}

std::optional<Shadow> shadow_of(const BeamFrame& frame, const glm::dvec3& point_lps_mm) noexcept {
  const glm::dvec3 way = point_lps_mm - frame.source_lps_mm;
  const double depth_mm = glm::dot(way, frame.direction);
  if (!(depth_mm > 1.0)) return std::nullopt;  // within a millimetre of the focal spot nothing has a place
  const double magnification = frame.sid_mm / depth_mm;
  return Shadow{{glm::dot(way, frame.u) * magnification, glm::dot(way, frame.v) * magnification}, magnification};
}

bool inside_field(const Fluoroscope& fluoroscope, int magnification, const Collimator& collimator,
                  const glm::dvec2& detector_mm) noexcept {
  const double half_mm = field_side_mm(fluoroscope, magnification) / 2.0;
  return std::abs(detector_mm.x) <= half_mm * collimator.open_u &&
         std::abs(detector_mm.y) <= half_mm * collimator.open_v;
}

}  // namespace seldinger::cases
