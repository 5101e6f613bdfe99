#include "sim/volume/gel_block.h"

#include <cmath>

#include "sim/base/check.h"

namespace seldinger::volume {

// Off the middle, so that each has to be looked for. The first is shallow and wide; the second 45 mm deep and as
// wide as a small lesion; the third deep enough that a tip beside the picture can miss it.
Sphere gel_ball(GelBlock block) noexcept {
  switch (block) {
    case GelBlock::find_the_plane:
      return {{-12.0, 22.0, 10.0}, 7.5};
    case GelBlock::keep_the_tip:
      return {{10.0, 45.0, -8.0}, 7.0};
    case GelBlock::out_of_plane:
      break;
  }
  return {{8.0, 30.0, 6.0}, 6.0};
}

AnalyticVolume gel_block_shapes(GelBlock block, const GelBlockOptions& options) {
  CHECK(options.spacing_mm > 0.0);
  const double half_voxel_mm = options.spacing_mm / 2.0;
  const glm::dvec3 low{-kGelSizeMm.x / 2.0, -kGelAboveMm, -kGelSizeMm.z / 2.0};
  const glm::dvec3 high{kGelSizeMm.x / 2.0, kGelSizeMm.y, kGelSizeMm.z / 2.0};
  AnalyticVolume analytic;
  analytic.spacing_mm = glm::dvec3(options.spacing_mm);
  analytic.origin_mm = low + half_voxel_mm;
  for (int axis = 0; axis < 3; ++axis)
    analytic.size_voxels[axis] = static_cast<int>(std::lround((high[axis] - low[axis]) / options.spacing_mm));
  analytic.shapes = {
      {.geometry = Box{{low.x, 0.0, low.z}, high}, .hu = kGelHu, .class_name = "gel"},
      {.geometry = Box{{low.x, 0.0, low.z}, {high.x, kGelSkinMm, high.z}}, .hu = kGelSkinHu, .class_name = "skin"},
      {.geometry = gel_ball(block), .hu = kGelBallHu, .class_name = "water"}};
  return analytic;
}

Phantom make_gel_block(GelBlock block, const GelBlockOptions& options) {
  Phantom made;
  made.volume = rasterize(gel_block_shapes(block, options), made.labels);
  add_ct_noise(options.noise_sd_hu, options.seed, made);
  return made;
}

}  // namespace seldinger::volume
