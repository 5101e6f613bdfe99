// The body as a coarser grid of clamped HU, closed where the volume ends: what the iso-surface is taken from.
#pragma once

#include <array>
#include <glm/vec3.hpp>
#include <vector>

#include "sim/volume/volume.h"

namespace seldinger::casedb {

// Each axis holds: air and a copy of the first layer, both on the volume's face, the layers, the same at the end.
// So a body that runs out of the volume ends flat on the face (half a voxel beyond the outermost centres).
struct SurfaceGrid {
  glm::ivec3 size{0};
  std::vector<float> hu;
  std::array<std::vector<double>, 3> voxel_from_layer;  // where a layer lies, as index of the volume

  // A continuous index of the grid as index of the volume.
  glm::dvec3 voxel_at(const glm::dvec3& layer) const;
  // Of the layers nearest to a continuous index of the volume; beyond its faces of those at them.
  float hu_at(const glm::dvec3& voxel) const;
};

// Filled air inside the body becomes water, everything dense outside it air. Blocks of voxels are averaged up to
// about `target_spacing_mm`. Empty (size 0) when there is no body.
SurfaceGrid surface_grid(const volume::Volume& volume, int iso_hu, double target_spacing_mm);

}  // namespace seldinger::casedb
