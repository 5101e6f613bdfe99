#include "sim/case/c_arm.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "sim/base/exact_math.h"

namespace seldinger::cases {
namespace {

constexpr double kRadPerDeg = std::numbers::pi / 180.0;

// A prone patient is the supine one turned by half a turn about his long axis: the rays then run from the front to
// the back, and what the machine calls left is his right, so LAO is the other way round for the machine.
double towards_back(PatientPosition position) noexcept {
  return position == PatientPosition::prone ? 1.0 : -1.0;
}

}  // namespace

glm::dvec3 beam_direction(double lao_deg, double cranial_deg, PatientPosition position) noexcept {
  const double lao = lao_deg * kRadPerDeg, cranial = cranial_deg * kRadPerDeg;
  const double level = base::exact_cos(cranial);
  return {base::exact_sin(lao) * level, towards_back(position) * base::exact_cos(lao) * level,
          base::exact_sin(cranial)};
}

BeamAngles angles_of_beam(const glm::dvec3& direction, PatientPosition position) noexcept {
  const double ahead = towards_back(position) * direction.y;
  const double level = std::sqrt(direction.x * direction.x + direction.y * direction.y);
  BeamAngles angles;
  if (ahead > 0.0)
    angles.lao_deg = base::exact_atan(direction.x / ahead) / kRadPerDeg;
  else if (ahead < 0.0)
    angles.lao_deg = base::exact_atan(direction.x / ahead) / kRadPerDeg + (direction.x < 0.0 ? -180.0 : 180.0);
  else if (direction.x != 0.0)
    angles.lao_deg = direction.x > 0.0 ? 90.0 : -90.0;
  if (level > 0.0)
    angles.cranial_deg = base::exact_atan(direction.z / level) / kRadPerDeg;
  else
    angles.cranial_deg = direction.z < 0.0 ? -90.0 : 90.0;
  return angles;
}

BeamFrame beam_frame(const Fluoroscope& fluoroscope, const CArm& arm, PatientPosition position) noexcept {
  BeamFrame frame;
  const double lao = arm.lao_deg * kRadPerDeg;
  frame.direction = beam_direction(arm.lao_deg, arm.cranial_deg, position);
  frame.u = {-towards_back(position) * base::exact_cos(lao), base::exact_sin(lao), 0.0};
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
