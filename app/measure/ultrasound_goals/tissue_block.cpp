#include "app/measure/ultrasound_goals/tissue_block.h"

#include <array>

namespace seldinger::measure {
namespace {

// By volume::TissueClass.
constexpr std::array<std::int16_t, volume::kTissueClasses> kHu = {-1000, -1000, -700, -90, 5,  50,  60,  35,
                                                                  50,    55,    60,   90,  40, 700, 3000};

}  // namespace

TissueBlock tissue_block(const std::function<volume::TissueClass(const glm::dvec3& lps_mm)>& class_at,
                         glm::ivec3 size_voxels, double voxel_mm) {
  TissueBlock block;
  block.volume = volume::make_volume(
      size_voxels, glm::dvec3(voxel_mm), glm::dmat3(1.0),
      {-0.5 * (size_voxels.x - 1) * voxel_mm, -30.0 + 0.5 * voxel_mm, -0.5 * (size_voxels.z - 1) * voxel_mm});
  block.classes.resize(block.volume.hu.size());
  for (int k = 0; k < size_voxels.z; ++k)
    for (int j = 0; j < size_voxels.y; ++j)
      for (int i = 0; i < size_voxels.x; ++i) {
        const std::size_t at = block.volume.index(i, j, k);
        block.classes[at] = class_at(glm::dvec3(block.volume.lps_from_voxel * glm::dvec4(i, j, k, 1)));
        block.volume.hu[at] = kHu[static_cast<std::size_t>(block.classes[at])];
      }
  return block;
}

TissueBlock block_of(volume::TissueClass tissue) {
  return tissue_block([=](const glm::dvec3&) { return tissue; });
}

}  // namespace seldinger::measure
