// The wall about chest and belly, under which breath lets organs slide: how far it is from an axis, by height and
// direction.
#pragma once

#include <array>
#include <glm/vec3.hpp>
#include <optional>

#include "shaders/shared/displacement_source.glsl.h"
#include "sim/case/case.h"

namespace seldinger::tissue {

struct CavityWall {
  glm::dvec3 axis_lps_mm{0.0};  // x and y of the axis, which runs head to feet; z of the lowest height
  double step_mm = 0.0;         // from height to height, > 0
  // To the wall's inner side, of each height those of all directions, counted as displacement_sliding does.
  std::array<float, shaders::kCavityNodes> radius_mm{};
};

// From skin and classes. By a label, or by lung, gas and bone, the wall ends where they say; where only fat and
// soft tissue are told apart it is taken to be as thick as its muscles are. Nothing without classes or without
// bone.
std::optional<CavityWall> cavity_wall(const cases::Case& scene);

}  // namespace seldinger::tissue
