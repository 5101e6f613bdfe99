#include "sim/imaging/xray/projection/attenuating_box.h"

#include <glm/common.hpp>

namespace seldinger::imaging {

VoxelBox attenuating_box(const volume::Volume& volume) noexcept {
  const glm::ivec3 size = volume.size_voxels;
  VoxelBox box{size, glm::ivec3(0)};
  const std::int16_t* row = volume.hu.data();
  for (int k = 0; k < size.z; ++k)
    for (int j = 0; j < size.y; ++j, row += size.x) {
      int first = 0, end = size.x;
      while (first < size.x && row[first] <= kNothingHu) ++first;
      if (first == size.x) continue;
      while (row[end - 1] <= kNothingHu) --end;
      box.low = glm::min(box.low, glm::ivec3(first, j, k));
      box.high = glm::max(box.high, glm::ivec3(end, j + 1, k + 1));
    }
  return box;
}

VoxelBox grown(const VoxelBox& box, const glm::ivec3& size_voxels) noexcept {
  return {glm::max(box.low - 1, glm::ivec3(0)), glm::min(box.high + 1, size_voxels)};
}

}  // namespace seldinger::imaging
