// Where a haptic device stands: rotation, translation and scale from its own coordinates to the template's that it
// was put on (thesis §5.4). The template is a board with a cross and a box of known height on it; x runs along the
// cross from a to b, y up, z from c to d, the origin where its lines meet.
#pragma once

#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "sim/base/result.h"

namespace seldinger::devices {

struct TemplatePoint {
  const char* name;
  glm::dvec3 template_mm;
  bool height_only;  // anywhere on the box: x and z say nothing
  bool required;
  const char* source;
};

// a to f.
std::span<const TemplatePoint> template_points() noexcept;

// What the device read at a point when its button was pressed, in its own axes.
struct TakenPoint {
  std::string name;
  glm::dvec3 device_mm{0.0};
};

// p_template_mm = scale · rotation · p_device_mm + translation_mm
struct Placement {
  glm::dmat3 rotation{1.0};
  double scale = 1.0;
  glm::dvec3 translation_mm{0.0};
  glm::dvec3 operator()(const glm::dvec3& device_mm) const noexcept {
    return scale * (rotation * device_mm) + translation_mm;
  }
};

// The way back. Its scale is not 0.
inline Placement inverse_of(const Placement& placement) noexcept {
  Placement inverse;
  inverse.rotation = glm::transpose(placement.rotation);
  inverse.scale = 1.0 / placement.scale;
  inverse.translation_mm = -inverse.scale * (inverse.rotation * placement.translation_mm);
  return inverse;
}

struct Calibration {
  struct Point {
    TakenPoint taken;
    double residual_mm;  // of what the template tells of this point
  };
  Placement template_from_device;
  std::vector<Point> points;  // in the template's order
  double residual_rms_mm = 0.0, residual_max_mm = 0.0;
};

// Our judgement.
inline constexpr double kMostResidualMm = 1.0;
// Beyond these a device does not read millimetres (design).
inline constexpr double kLeastScale = 0.1, kMostScale = 10.0;

// Least squares over all points with one scale; the residuals are exact to rounding. Refused with every fault
// found: `bad_points` (an unknown name, a point twice or missing, no finite numbers), `collinear`, `coplanar` (f is
// no higher than the board, so that a mirrored device would look the same), `mirrored` (f comes out below the
// board: a device with an axis turned over, or points taken in another order), `wrong_scale`, `wrong_point` (a
// residual above kMostResidualMm; each such point, and which one the others would do without).
base::Result<Calibration> calibrate(std::span<const TakenPoint> taken);

// The placement that brings `from` closest to `to` in the sum of squares: Horn, J. Opt. Soc. Am. A 4, 1987 (the
// rotation as a quaternion, never a reflection), scale after Umeyama, IEEE PAMI 13, 1991. As many of each, at least
// three, not on one line (CHECKed for the number only).
Placement closest_placement(std::span<const glm::dvec3> from, std::span<const glm::dvec3> to);

}  // namespace seldinger::devices
