// Rotations of a held tool.
#pragma once

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "sim/case/inputs.h"

namespace seldinger::devices {

// v turned by the rotation vector turn_rad (Rodrigues).
inline glm::dvec3 turned(const glm::dvec3& v, const glm::dvec3& turn_rad) noexcept {
  const double angle_rad = glm::length(turn_rad);
  if (!(angle_rad > 0.0)) return v;
  const glm::dvec3 about = turn_rad / angle_rad;
  const double sine = std::sin(angle_rad), cosine = std::cos(angle_rad);
  return v * cosine + glm::cross(about, v) * sine + about * (glm::dot(about, v) * (1.0 - cosine));
}

// The shortest rotation vector from one unit vector to another. Of opposite ones: none.
inline glm::dvec3 turn_between(const glm::dvec3& from, const glm::dvec3& to) noexcept {
  const glm::dvec3 across = glm::cross(from, to);
  const double sine = glm::length(across);
  return sine > 1e-12 ? across * (std::atan2(sine, glm::dot(from, to)) / sine) : glm::dvec3(0.0);
}

// No longer than `most`.
inline glm::dvec3 limited(const glm::dvec3& v, double most) noexcept {
  const double length = glm::length(v);
  return length > most ? v * (most / length) : v;
}

// Unit axis, and side perpendicular to it. A side along the axis, or none, becomes any perpendicular.
inline void square_up(cases::ToolPose& pose) noexcept {
  pose.axis = glm::normalize(pose.axis);
  glm::dvec3 side = pose.side - pose.axis * glm::dot(pose.side, pose.axis);
  if (!(glm::dot(side, side) > 1e-12))
    side = glm::cross(pose.axis, std::abs(pose.axis.x) < 0.5 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0));
  pose.side = glm::normalize(side);
}

inline void turn(const glm::dvec3& turn_rad, cases::ToolPose& pose) noexcept {
  pose.axis = turned(pose.axis, turn_rad);
  pose.side = turned(pose.side, turn_rad);
  square_up(pose);
}

// The pose's turn from own angles (tilt, rock, rotate) as a rotation vector in space.
inline glm::dvec3 in_space(const glm::dvec3& own_rad, const cases::ToolPose& pose) noexcept {
  return pose.side * own_rad.x + glm::cross(pose.axis, pose.side) * own_rad.y + pose.axis * own_rad.z;
}

}  // namespace seldinger::devices
