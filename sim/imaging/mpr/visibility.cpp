#include "sim/imaging/mpr/visibility.h"

#include <cmath>
#include <glm/geometric.hpp>

#include "sim/imaging/mpr/plane.h"
#include "sim/imaging/segment_clip.h"

namespace seldinger::imaging {
namespace {

// The box around what the picture shows: along u, v and the plane's normal, half widths from the view's centre.
struct Field {
  glm::dvec3 axes[3];
  double half_mm[3];
};

Field field_of(const MprView& view) noexcept {
  return {{view.u, view.v, glm::cross(view.u, view.v)},
          {0.5 * view.pixel_mm * view.width_px, 0.5 * view.pixel_mm * view.height_px, kMprSlabHalfMm}};
}

// On the border counts as inside; NaN does not.
bool contains(const Field& field, const glm::dvec3& from_center_mm) noexcept {
  for (int axis = 0; axis < 3; ++axis)
    if (!(std::abs(glm::dot(field.axes[axis], from_center_mm)) <= field.half_mm[axis])) return false;
  return true;
}

double length_inside_mm(const Field& field, const NeedlePose& needle, const glm::dvec3& center_lps_mm) noexcept {
  const glm::dvec3 tip_mm = needle.tip_lps_mm - center_lps_mm;
  const glm::dvec3 shaft_mm = -needle.length_mm * needle.direction;
  if (!is_finite(tip_mm) || !is_finite(shaft_mm)) return 0.0;
  SegmentPart part;
  for (int axis = 0; axis < 3; ++axis)
    part = clip(part, glm::dot(field.axes[axis], tip_mm), glm::dot(field.axes[axis], shaft_mm),
                -field.half_mm[axis], field.half_mm[axis]);
  return part.from <= part.to ? (part.to - part.from) * glm::length(shaft_mm) : 0.0;
}

}  // namespace

Visible mpr_visible(const MprView& view, const std::optional<NeedlePose>& needle,
                    const std::optional<glm::dvec3>& target_lps_mm) noexcept {
  const Field field = field_of(view);
  Visible visible;
  if (needle) {
    visible.needle_tip = contains(field, needle->tip_lps_mm - view.center_lps_mm);
    visible.needle_length_mm = length_inside_mm(field, *needle, view.center_lps_mm);
  }
  if (target_lps_mm) visible.target = contains(field, *target_lps_mm - view.center_lps_mm);
  visible.joint = visible.needle_tip && visible.target;
  return visible;
}

}  // namespace seldinger::imaging
