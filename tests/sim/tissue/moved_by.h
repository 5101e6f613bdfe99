// How far a displacement takes a point.
#pragma once

#include <glm/vec3.hpp>

#include "sim/tissue/displacement.h"

namespace seldinger::tissue {

inline glm::dvec3 u_of(const Displacement& displacement, const glm::dvec3& rest_mm) {
  return displaced(displacement, rest_mm) - rest_mm;
}

}  // namespace seldinger::tissue
