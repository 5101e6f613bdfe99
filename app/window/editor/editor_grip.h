// What of a case can be taken hold of on a plane, and what it becomes when it is dragged: lesions and drawn
// structures by their middle or their rim, tubes by their points.
#pragma once

#include <cstddef>
#include <glm/vec3.hpp>
#include <optional>

#include "app/replay/plane_lines.h"
#include "sim/case/form/shape.h"
#include "sim/case/lesion_form.h"

namespace seldinger::app {

enum class GripPart { middle, rim, point };

struct Grip {
  GripPart part = GripPart::middle;
  std::size_t point = 0;  // of a tube
};

// At a place of a plane, within `reach_mm` of it on that plane; a middle or point only where the shape is on the
// plane at all. Nothing of voxels.
std::optional<Grip> grip_of(const cases::Shape& shape, const PlaneKind& plane, const glm::dvec3& at_lps_mm,
                            double reach_mm);
std::optional<Grip> grip_of(const cases::LesionForm& form, const PlaneKind& plane, const glm::dvec3& at_lps_mm,
                            double reach_mm);

// Held there and dragged to a place of the plane: a rim goes through it, a middle or a point goes to it. Across the
// plane nothing moves.
void drag(const Grip& grip, const PlaneKind& plane, const glm::dvec3& to_lps_mm, cases::Shape& shape);
void drag(const Grip& grip, const PlaneKind& plane, const glm::dvec3& to_lps_mm, cases::LesionForm& form);

}  // namespace seldinger::app
