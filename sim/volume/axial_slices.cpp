#include "sim/volume/axial_slices.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

namespace seldinger::volume {
namespace {

class SliceFill {
 public:
  SliceFill(const AxialSlices& slices, std::vector<std::uint8_t>& mask) : slices_(slices), mask_(mask) {}

  void fill(int slice) {
    slice_ = slice;
    const int width = slices_.width(), height = slices_.height();
    outside_.assign(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), 0);
    for (int x = 0; x < width; ++x) reach(x, 0), reach(x, height - 1);
    for (int y = 0; y < height; ++y) reach(0, y), reach(width - 1, y);
    while (!open_.empty()) {
      const int at = open_.back(), x = at % width, y = at / width;
      open_.pop_back();
      if (x > 0) reach(x - 1, y);
      if (x + 1 < width) reach(x + 1, y);
      if (y > 0) reach(x, y - 1);
      if (y + 1 < height) reach(x, y + 1);
    }
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x)
        if (outside_[static_cast<std::size_t>(y * width + x)] == 0) mask_[slices_.voxel(slice_, x, y)] = 1;
  }

 private:
  void reach(int x, int y) {
    std::uint8_t& seen = outside_[static_cast<std::size_t>(y * slices_.width() + x)];
    if (seen != 0 || mask_[slices_.voxel(slice_, x, y)] != 0) return;
    seen = 1;
    open_.push_back(y * slices_.width() + x);
  }

  const AxialSlices& slices_;
  std::vector<std::uint8_t>& mask_;
  int slice_ = 0;
  std::vector<std::uint8_t> outside_;
  std::vector<int> open_;
};

// Grows the voxels of `value` by `radius` along a row. A row beyond its ends is neither body nor not, so nothing
// grows in from there.
void grow_row(std::uint8_t* row, int count, int radius, std::uint8_t value, int* since) {
  int last = radius + 1;
  for (int i = 0; i < count; ++i) since[i] = last = row[i] == value ? 0 : last + 1;
  last = radius + 1;
  for (int i = count - 1; i >= 0; --i) {
    last = row[i] == value ? 0 : last + 1;
    if (std::min(last, since[i]) <= radius) row[i] = value;
  }
}

}  // namespace

void grow_slice(std::vector<std::uint8_t>& slice, int width, int height, glm::ivec2 radius, std::uint8_t value,
                std::vector<int>& scratch) {
  const auto w = static_cast<std::size_t>(width), h = static_cast<std::size_t>(height);
  scratch.resize(w * h + w);
  for (std::size_t y = 0; y < h; ++y)
    if (std::memchr(slice.data() + y * w, value, w) != nullptr)
      grow_row(slice.data() + y * w, width, radius.x, value, scratch.data());
  // Down and up all columns at once, row by row as they lie in memory.
  int* const last = scratch.data() + w * h;
  std::fill(last, last + w, radius.y + 1);
  for (std::size_t y = 0; y < h; ++y) {
    const std::uint8_t* row = slice.data() + y * w;
    int* since = scratch.data() + y * w;
    for (std::size_t x = 0; x < w; ++x) since[x] = last[x] = row[x] == value ? 0 : last[x] + 1;
  }
  std::fill(last, last + w, radius.y + 1);
  for (std::size_t y = h; y-- > 0;) {
    std::uint8_t* row = slice.data() + y * w;
    const int* since = scratch.data() + y * w;
    for (std::size_t x = 0; x < w; ++x) {
      last[x] = row[x] == value ? 0 : last[x] + 1;
      row[x] = std::min(last[x], since[x]) <= radius.y ? value : row[x];
    }
  }
}

AxialSlices::AxialSlices(const Volume& volume) {
  int axial = 0;
  double best_cosine = -1.0;
  for (int axis = 0; axis < 3; ++axis)
    if (const double cosine = std::abs(volume.lps_from_voxel[axis].z) / volume.spacing_mm[axis];
        cosine > best_cosine) {
      axial = axis;
      best_cosine = cosine;
    }
  const int x = axial == 0 ? 1 : 0, y = axial == 2 ? 1 : 2;
  const glm::ivec3 size = volume.size_voxels;
  const std::array<std::size_t, 3> step = {1, static_cast<std::size_t>(size.x),
                                           static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y)};
  count_ = size[axial];
  width_ = size[x];
  height_ = size[y];
  spacing_mm_ = {volume.spacing_mm[x], volume.spacing_mm[y]};
  step_slice_ = step[static_cast<std::size_t>(axial)];
  step_x_ = step[static_cast<std::size_t>(x)];
  step_y_ = step[static_cast<std::size_t>(y)];
}

void fill_slices(const AxialSlices& slices, std::vector<std::uint8_t>& mask) {
  SliceFill fill(slices, mask);
  for (int slice = 0; slice < slices.count(); ++slice) fill.fill(slice);
}

std::vector<std::uint8_t> thin_parts(const AxialSlices& slices, const std::vector<std::uint8_t>& mask,
                                     glm::ivec2 radius_voxels) {
  const int width = slices.width(), height = slices.height();
  std::vector<std::uint8_t> thin(mask.size(), 0);
  std::vector<std::uint8_t> opened(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  std::vector<int> scratch;
  for (int slice = 0; slice < slices.count(); ++slice) {
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x)
        opened[static_cast<std::size_t>(y * width + x)] = mask[slices.voxel(slice, x, y)];
    grow_slice(opened, width, height, radius_voxels, 0, scratch);
    grow_slice(opened, width, height, radius_voxels + 1, 1, scratch);
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) {
        const std::size_t voxel = slices.voxel(slice, x, y);
        thin[voxel] = mask[voxel] != 0 && opened[static_cast<std::size_t>(y * width + x)] == 0 ? 1 : 0;
      }
  }
  return thin;
}

}  // namespace seldinger::volume
