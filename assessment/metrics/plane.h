// The plane of a picture that has one, from a probe's axes.
#pragma once

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <optional>

namespace seldinger::assessment {

// Unit normal; nothing where the axes span no plane (under 30° apart).
inline std::optional<glm::dvec3> plane_normal(const glm::dvec3& axial, const glm::dvec3& lateral) {
  constexpr double kMinSine = 0.5;
  const glm::dvec3 across = glm::cross(axial, lateral);
  const double sine = glm::length(across);
  if (!(sine >= kMinSine)) return std::nullopt;
  return across / sine;
}

}  // namespace seldinger::assessment
