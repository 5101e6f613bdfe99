#include "sim/volume/volume.h"

#include <algorithm>
#include <cmath>
#include <glm/matrix.hpp>

#include "sim/base/check.h"

namespace seldinger::volume {

Volume make_volume(glm::ivec3 size_voxels, glm::dvec3 spacing_mm, const glm::dmat3& direction,
                   glm::dvec3 origin_mm) {
  CHECK(size_voxels.x > 0 && size_voxels.y > 0 && size_voxels.z > 0);
  CHECK(spacing_mm.x > 0.0 && spacing_mm.y > 0.0 && spacing_mm.z > 0.0);
  Volume volume;
  volume.size_voxels = size_voxels;
  volume.spacing_mm = spacing_mm;
  for (int axis = 0; axis < 3; ++axis)
    volume.lps_from_voxel[axis] = glm::dvec4(direction[axis] * spacing_mm[axis], 0.0);
  volume.lps_from_voxel[3] = glm::dvec4(origin_mm, 1.0);
  volume.hu.assign(static_cast<std::size_t>(size_voxels.x) * static_cast<std::size_t>(size_voxels.y) *
                       static_cast<std::size_t>(size_voxels.z),
                   kAirHu);
  return volume;
}

glm::dmat4 voxel_from_lps(const Volume& volume) {
  return glm::inverse(volume.lps_from_voxel);
}

bool inside(const Volume& volume, const glm::dvec3& index) noexcept {
  for (int axis = 0; axis < 3; ++axis)
    if (!(index[axis] >= -0.5 && index[axis] <= volume.size_voxels[axis] - 0.5)) return false;  // NaN is outside
  return true;
}

std::optional<std::int16_t> sample_nearest(const Volume& volume, const glm::dvec3& index) noexcept {
  if (!inside(volume, index)) return std::nullopt;
  glm::ivec3 nearest;
  for (int axis = 0; axis < 3; ++axis)
    nearest[axis] = std::clamp(static_cast<int>(std::floor(index[axis] + 0.5)), 0, volume.size_voxels[axis] - 1);
  return volume.at(nearest.x, nearest.y, nearest.z);
}

std::optional<double> sample_trilinear(const Volume& volume, const glm::dvec3& index) noexcept {
  if (!inside(volume, index)) return std::nullopt;
  glm::ivec3 low, high;
  glm::dvec3 fraction;
  for (int axis = 0; axis < 3; ++axis) {
    const double clamped = std::clamp(index[axis], 0.0, volume.size_voxels[axis] - 1.0);
    low[axis] = static_cast<int>(clamped);
    high[axis] = std::min(low[axis] + 1, volume.size_voxels[axis] - 1);
    fraction[axis] = clamped - low[axis];
  }
  double sum = 0.0;
  for (int corner = 0; corner < 8; ++corner) {
    const bool x = (corner & 1) != 0, y = (corner & 2) != 0, z = (corner & 4) != 0;
    const double weight = (x ? fraction.x : 1.0 - fraction.x) * (y ? fraction.y : 1.0 - fraction.y) *
                          (z ? fraction.z : 1.0 - fraction.z);
    sum += weight * volume.at(x ? high.x : low.x, y ? high.y : low.y, z ? high.z : low.z);
  }
  return sum;
}

}  // namespace seldinger::volume
