// Small things about vectors that several folders need.
#pragma once

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace seldinger::base {

inline bool is_finite(const glm::dvec3& v) noexcept {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

// Two unit vectors that with the unit vector `axis` make a right-handed frame u, v, axis; the same on every
// machine.
struct Perpendiculars {
  glm::dvec3 u, v;
};
inline Perpendiculars perpendiculars(const glm::dvec3& axis) noexcept {
  const glm::dvec3 u =
      glm::normalize(glm::cross(axis, std::abs(axis.z) < 0.9 ? glm::dvec3(0, 0, 1) : glm::dvec3(1, 0, 0)));
  return {u, glm::cross(axis, u)};
}

}  // namespace seldinger::base
