#include "casedb/import/body_mask.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "sim/base/check.h"

namespace seldinger::casedb {
namespace {

// A row's voxels above the threshold, [begin, end).
struct Run {
  int begin, end;
  std::uint32_t parent;
};

class Runs {
 public:
  Runs(const volume::Volume& volume, int threshold_hu) : size_(volume.size_voxels) {
    row_first_.reserve(rows() + 1);
    for (std::size_t row = 0; row < rows(); ++row) {
      row_first_.push_back(static_cast<std::uint32_t>(runs_.size()));
      const std::int16_t* hu = volume.hu.data() + row * static_cast<std::size_t>(size_.x);
      for (int i = 0; i < size_.x; ++i) {
        if (hu[i] <= threshold_hu) continue;
        const int begin = i;
        while (i < size_.x && hu[i] > threshold_hu) ++i;
        runs_.push_back({begin, i, static_cast<std::uint32_t>(runs_.size())});
      }
    }
    row_first_.push_back(static_cast<std::uint32_t>(runs_.size()));
    const std::size_t slice = static_cast<std::size_t>(size_.y);
    for (std::size_t row = 0; row < rows(); ++row) {
      if (row % slice != 0) join_rows(row - 1, row);
      if (row >= slice) join_rows(row - slice, row);
    }
  }

  void write_largest(std::vector<std::uint8_t>& mask) {
    std::vector<std::size_t> voxels(runs_.size(), 0);
    for (std::uint32_t run = 0; run < runs_.size(); ++run)
      voxels[root(run)] += static_cast<std::size_t>(runs_[run].end - runs_[run].begin);
    if (voxels.empty()) return;
    const auto largest =
        static_cast<std::uint32_t>(std::max_element(voxels.begin(), voxels.end()) - voxels.begin());
    for (std::size_t row = 0; row < rows(); ++row)
      for (std::uint32_t run = row_first_[row]; run < row_first_[row + 1]; ++run)
        if (root(run) == largest) {
          const auto start = mask.begin() + static_cast<std::ptrdiff_t>(row * static_cast<std::size_t>(size_.x));
          std::fill(start + runs_[run].begin, start + runs_[run].end, std::uint8_t{1});
        }
  }

 private:
  std::size_t rows() const noexcept {
    return static_cast<std::size_t>(size_.y) * static_cast<std::size_t>(size_.z);
  }
  std::uint32_t root(std::uint32_t run) {
    while (runs_[run].parent != run) run = runs_[run].parent = runs_[runs_[run].parent].parent;
    return run;
  }
  void join_rows(std::size_t before, std::size_t row) {
    std::uint32_t a = row_first_[before], b = row_first_[row];
    while (a < row_first_[before + 1] && b < row_first_[row + 1]) {
      if (runs_[a].begin < runs_[b].end && runs_[b].begin < runs_[a].end) {
        const std::uint32_t root_a = root(a), root_b = root(b);
        runs_[std::max(root_a, root_b)].parent = std::min(root_a, root_b);
      }
      runs_[a].end < runs_[b].end ? ++a : ++b;
    }
  }

  glm::ivec3 size_;
  std::vector<Run> runs_;
  std::vector<std::uint32_t> row_first_;
};

// The voxel axis nearest to the patient's head-foot axis.
int axial_axis(const volume::Volume& volume) {
  int best = 0;
  double best_cosine = -1.0;
  for (int axis = 0; axis < 3; ++axis)
    if (const double cosine = std::abs(volume.lps_from_voxel[axis].z) / volume.spacing_mm[axis];
        cosine > best_cosine) {
      best = axis;
      best_cosine = cosine;
    }
  return best;
}

// One axial slice of the mask: everything its border's background does not reach (4 neighbours) becomes body.
class SliceFill {
 public:
  SliceFill(std::vector<std::uint8_t>& mask, int width, int height, std::size_t step_x, std::size_t step_y)
      : mask_(mask), width_(width), height_(height), step_x_(step_x), step_y_(step_y) {}

  void fill(std::size_t first) {
    outside_.assign(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_), 0);
    first_ = first;
    for (int x = 0; x < width_; ++x) reach(x, 0), reach(x, height_ - 1);
    for (int y = 0; y < height_; ++y) reach(0, y), reach(width_ - 1, y);
    while (!open_.empty()) {
      const int at = open_.back(), x = at % width_, y = at / width_;
      open_.pop_back();
      if (x > 0) reach(x - 1, y);
      if (x + 1 < width_) reach(x + 1, y);
      if (y > 0) reach(x, y - 1);
      if (y + 1 < height_) reach(x, y + 1);
    }
    for (int y = 0; y < height_; ++y)
      for (int x = 0; x < width_; ++x)
        if (outside_[static_cast<std::size_t>(y * width_ + x)] == 0) mask_[voxel(x, y)] = 1;
  }

 private:
  std::size_t voxel(int x, int y) const noexcept {
    return first_ + static_cast<std::size_t>(x) * step_x_ + static_cast<std::size_t>(y) * step_y_;
  }
  void reach(int x, int y) {
    std::uint8_t& seen = outside_[static_cast<std::size_t>(y * width_ + x)];
    if (seen != 0 || mask_[voxel(x, y)] != 0) return;
    seen = 1;
    open_.push_back(y * width_ + x);
  }

  std::vector<std::uint8_t>& mask_;
  int width_, height_;
  std::size_t step_x_, step_y_, first_ = 0;
  std::vector<std::uint8_t> outside_;
  std::vector<int> open_;
};

}  // namespace

std::vector<std::uint8_t> body_mask(const volume::Volume& volume, int threshold_hu) {
  std::vector<std::uint8_t> mask(volume.hu.size(), 0);
  Runs(volume, threshold_hu).write_largest(mask);
  if (std::find(mask.begin(), mask.end(), std::uint8_t{1}) == mask.end()) return mask;
  const glm::ivec3 size = volume.size_voxels;
  const std::array<std::size_t, 3> step = {
      1, static_cast<std::size_t>(size.x), static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y)};
  const int axis = axial_axis(volume), x = axis == 0 ? 1 : 0, y = axis == 2 ? 1 : 2;
  const auto step_of = [&](int of) { return step[static_cast<std::size_t>(of)]; };
  SliceFill slice(mask, size[x], size[y], step_of(x), step_of(y));
  for (int k = 0; k < size[axis]; ++k) slice.fill(static_cast<std::size_t>(k) * step_of(axis));
  return mask;
}

}  // namespace seldinger::casedb
