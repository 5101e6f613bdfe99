// Planes of the CT as radiologists look at them, and what of a body they cut: lines for a drawing.
#pragma once

#include <array>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "sim/case/form/mesh.h"
#include "sim/case/form/shape.h"

namespace seldinger::app {

struct PlaneKind {
  const char* name;                          // Axial, Coronal, Sagittal
  const char *left, *right, *upper, *lower;  // the patient's sides there: "R", "L", "A", "P", "H", "F"
  glm::dvec3 u, v;                           // unit, LPS: to the right, down
};
// Seen from the feet, from the front, from the left.
const std::array<PlaneKind, 3>& plane_kinds() noexcept;

// A rectangle of a plane.
struct PlaneFrame {
  glm::dvec3 corner_lps_mm{0.0}, u{1.0, 0.0, 0.0}, v{0.0, 1.0, 0.0};  // upper left; to the right; down
  glm::dvec2 size_mm{0.0};

  // Millimetres to the right of and below the corner, of a point projected onto the plane.
  glm::dvec2 at(const glm::dvec3& point_lps_mm) const noexcept;
};

// Both ends as PlaneFrame::at.
struct PlaneSegment {
  glm::dvec2 from_mm, to_mm;
};

// Where the plane cuts the skin; the caps at the volume's ends are none.
std::vector<PlaneSegment> skin_lines(const cases::Mesh& skin, const PlaneFrame& frame);

// Around what of a shape lies in the rectangle: the edges of the pixels (of this size) whose middles lie inside,
// each run of them one segment.
std::vector<PlaneSegment> outline(const cases::Shape& shape, const PlaneFrame& frame, double pixel_mm);

}  // namespace seldinger::app
