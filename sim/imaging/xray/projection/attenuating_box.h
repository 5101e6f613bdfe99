// The smallest box of voxels that attenuate at all: what projectors keep of a volume.
#pragma once

#include <glm/vec3.hpp>

#include "sim/volume/volume.h"

namespace seldinger::imaging {

constexpr int kNothingHu = -1000;  // at and below it nothing attenuates

// low ≤ index < high.
struct VoxelBox {
  glm::ivec3 low{0}, high{0};
  glm::ivec3 size() const noexcept { return high - low; }
  bool empty() const noexcept { return high.x <= low.x || high.y <= low.y || high.z <= low.z; }
};

// Of the voxels above kNothingHu; empty when there are none.
VoxelBox attenuating_box(const volume::Volume& volume) noexcept;

// With one voxel more on every side where a volume of this size has one: interpolation reaches half a voxel into
// it.
VoxelBox grown(const VoxelBox& box, const glm::ivec3& size_voxels) noexcept;

}  // namespace seldinger::imaging
