#include "casedb/import/skin/surface_grid.h"

#include <algorithm>
#include <cmath>

#include "sim/volume/body/body_mask.h"

namespace seldinger::casedb {
namespace {

// The surface needs only the step from air to tissue: bone and metal must not pull it outwards, nor padding
// inwards.
constexpr float kAir = -1000.0F, kMostHu = 200.0F, kFilled = 0.0F;
// A layer exactly at the iso value would give triangles without area; this moves it by less than 1 % of a voxel.
constexpr float kOffIso = 4.0F;

struct Blocks {
  int factor = 1, count = 1;
};

Blocks blocks_of(int voxels, double spacing_mm, double target_mm) {
  const int factor = std::clamp(static_cast<int>(std::lround(target_mm / spacing_mm)), 1, voxels);
  return {factor, (voxels + factor - 1) / factor};
}

// Layers of one axis; the last block may hold fewer voxels, its centre then lies nearer.
std::vector<double> places(int voxels, const Blocks& blocks) {
  std::vector<double> at = {-0.5, -0.5};
  for (int block = 0; block < blocks.count; ++block) {
    const int first = block * blocks.factor, last = std::min(first + blocks.factor, voxels) - 1;
    at.push_back(0.5 * (first + last));
  }
  at.insert(at.end(), 2, voxels - 0.5);
  return at;
}

std::vector<float> averaged(const volume::Volume& volume, const std::vector<std::uint8_t>& body, int iso_hu,
                            const std::array<Blocks, 3>& blocks) {
  const glm::ivec3 size = volume.size_voxels;
  const std::size_t row = static_cast<std::size_t>(blocks[0].count),
                    slice = row * static_cast<std::size_t>(blocks[1].count);
  std::vector<float> sum(slice * static_cast<std::size_t>(blocks[2].count), 0.0F);
  for (int k = 0; k < size.z; ++k)
    for (int j = 0; j < size.y; ++j) {
      float* out = sum.data() + static_cast<std::size_t>(k / blocks[2].factor) * slice +
                   static_cast<std::size_t>(j / blocks[1].factor) * row;
      for (int i = 0; i < size.x; ++i) {
        const std::size_t voxel = volume.index(i, j, k);
        const bool dense = volume.hu[voxel] > iso_hu;
        float hu = std::clamp(static_cast<float>(volume.hu[voxel]), kAir, kMostHu);
        if (body[voxel] != 0 && !dense) hu = kFilled;
        if (body[voxel] == 0 && dense) hu = kAir;
        out[i / blocks[0].factor] += hu;
      }
    }
  const auto share = [&](int block, int axis) {
    const Blocks& b = blocks[static_cast<std::size_t>(axis)];
    return std::min((block + 1) * b.factor, size[axis]) - block * b.factor;
  };
  for (int k = 0; k < blocks[2].count; ++k)
    for (int j = 0; j < blocks[1].count; ++j)
      for (int i = 0; i < blocks[0].count; ++i) {
        float& value = sum[static_cast<std::size_t>(k) * slice + static_cast<std::size_t>(j) * row +
                           static_cast<std::size_t>(i)];
        value /= static_cast<float>(share(i, 0) * share(j, 1) * share(k, 2));
        const float over = value - static_cast<float>(iso_hu);
        if (std::abs(over) < kOffIso) value = static_cast<float>(iso_hu) + (over > 0.0F ? kOffIso : -kOffIso);
      }
  return sum;
}

}  // namespace

glm::dvec3 SurfaceGrid::voxel_at(const glm::dvec3& layer) const {
  glm::dvec3 voxel;
  for (int axis = 0; axis < 3; ++axis) {
    const std::vector<double>& at = voxel_from_layer[static_cast<std::size_t>(axis)];
    const int low = std::clamp(static_cast<int>(layer[axis]), 0, static_cast<int>(at.size()) - 2);
    const double part = layer[axis] - low, from = at[static_cast<std::size_t>(low)],
                 to = at[static_cast<std::size_t>(low) + 1];
    voxel[axis] = from + part * (to - from);
  }
  return voxel;
}

float SurfaceGrid::hu_at(const glm::dvec3& voxel) const {
  glm::ivec3 nearest(0);
  for (int axis = 0; axis < 3; ++axis) {
    const std::vector<double>& at = voxel_from_layer[static_cast<std::size_t>(axis)];
    const auto first = at.begin() + 2, last = at.end() - 3;  // the layers, without what closes them
    const auto above = std::lower_bound(first, last, voxel[axis]);
    const bool below = above != first && voxel[axis] - *(above - 1) < *above - voxel[axis];
    nearest[axis] = static_cast<int>(above - at.begin()) - (below ? 1 : 0);
  }
  return hu[(static_cast<std::size_t>(nearest.z) * static_cast<std::size_t>(size.y) +
             static_cast<std::size_t>(nearest.y)) *
                static_cast<std::size_t>(size.x) +
            static_cast<std::size_t>(nearest.x)];
}

SurfaceGrid surface_grid(const volume::Volume& volume, int iso_hu, double target_spacing_mm) {
  SurfaceGrid grid;
  const std::vector<std::uint8_t> body = body_mask(volume, iso_hu);
  if (std::find(body.begin(), body.end(), std::uint8_t{1}) == body.end()) return grid;
  std::array<Blocks, 3> blocks;
  for (int axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<std::size_t>(axis);
    blocks[a] = blocks_of(volume.size_voxels[axis], volume.spacing_mm[axis], target_spacing_mm);
    grid.voxel_from_layer[a] = places(volume.size_voxels[axis], blocks[a]);
    grid.size[axis] = blocks[a].count + 4;
  }
  const std::vector<float> inner = averaged(volume, body, iso_hu, blocks);
  grid.hu.assign(static_cast<std::size_t>(grid.size.x) * static_cast<std::size_t>(grid.size.y) *
                     static_cast<std::size_t>(grid.size.z),
                 kAir);
  const auto block_of = [&](int layer, int axis) {  // the outermost layers are repeated on the faces
    return static_cast<std::size_t>(std::clamp(layer - 2, 0, blocks[static_cast<std::size_t>(axis)].count - 1));
  };
  const std::size_t row = static_cast<std::size_t>(blocks[0].count),
                    slice = row * static_cast<std::size_t>(blocks[1].count);
  for (int k = 1; k + 1 < grid.size.z; ++k)
    for (int j = 1; j + 1 < grid.size.y; ++j)
      for (int i = 1; i + 1 < grid.size.x; ++i)
        grid.hu[(static_cast<std::size_t>(k) * static_cast<std::size_t>(grid.size.y) +
                 static_cast<std::size_t>(j)) *
                    static_cast<std::size_t>(grid.size.x) +
                static_cast<std::size_t>(i)] =
            inner[block_of(k, 2) * slice + block_of(j, 1) * row + block_of(i, 0)];
  return grid;
}

}  // namespace seldinger::casedb
