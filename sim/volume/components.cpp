#include "sim/volume/components.h"

#include <algorithm>
#include <glm/common.hpp>

namespace seldinger::volume {

Components::Components(glm::ivec3 size_voxels, const std::vector<std::uint8_t>& mask) : size_(size_voxels) {
  row_first_.reserve(rows() + 1);
  for (std::size_t row = 0; row < rows(); ++row) {
    row_first_.push_back(static_cast<std::uint32_t>(runs_.size()));
    const std::uint8_t* voxel = mask.data() + row * static_cast<std::size_t>(size_.x);
    for (int i = 0; i < size_.x; ++i) {
      if (voxel[i] == 0) continue;
      const int begin = i;
      while (i < size_.x && voxel[i] != 0) ++i;
      runs_.push_back({begin, i, static_cast<std::uint32_t>(runs_.size())});
    }
  }
  row_first_.push_back(static_cast<std::uint32_t>(runs_.size()));
  const std::size_t slice_rows = static_cast<std::size_t>(size_.y);
  for (std::size_t row = 0; row < rows(); ++row) {
    if (row % slice_rows != 0) join_rows(row - 1, row);
    if (row >= slice_rows) join_rows(row - slice_rows, row);
  }
}

std::uint32_t Components::root(std::uint32_t run) {
  while (runs_[run].parent != run) run = runs_[run].parent = runs_[runs_[run].parent].parent;
  return run;
}

void Components::join_rows(std::size_t before, std::size_t row) {
  std::uint32_t a = row_first_[before], b = row_first_[row];
  while (a < row_first_[before + 1] && b < row_first_[row + 1]) {
    if (runs_[a].begin < runs_[b].end && runs_[b].begin < runs_[a].end) {
      const std::uint32_t root_a = root(a), root_b = root(b);
      runs_[std::max(root_a, root_b)].parent = std::min(root_a, root_b);
    }
    runs_[a].end < runs_[b].end ? ++a : ++b;
  }
}

std::vector<Piece> Components::pieces() {
  std::vector<Piece> pieces(runs_.size());
  for (std::size_t row = 0; row < rows(); ++row)
    for (std::uint32_t run = row_first_[row]; run < row_first_[row + 1]; ++run) {
      Piece& piece = pieces[root(run)];
      const int j = static_cast<int>(row % static_cast<std::size_t>(size_.y)),
                k = static_cast<int>(row / static_cast<std::size_t>(size_.y));
      const glm::ivec3 low(runs_[run].begin, j, k), high(runs_[run].end - 1, j, k);
      piece.low = piece.voxels == 0 ? low : glm::min(piece.low, low);
      piece.high = piece.voxels == 0 ? high : glm::max(piece.high, high);
      piece.voxels += static_cast<std::size_t>(runs_[run].end - runs_[run].begin);
    }
  return pieces;
}

void Components::paint_roots(const std::vector<std::uint8_t>& picked, std::uint8_t value,
                             std::vector<std::uint8_t>& mask) {
  for (std::size_t row = 0; row < rows(); ++row)
    for (std::uint32_t run = row_first_[row]; run < row_first_[row + 1]; ++run) {
      if (picked[root(run)] == 0) continue;
      const auto start = mask.begin() + static_cast<std::ptrdiff_t>(row * static_cast<std::size_t>(size_.x));
      std::fill(start + runs_[run].begin, start + runs_[run].end, value);
    }
}

void Components::paint(const std::function<bool(const Piece&)>& which, std::uint8_t value,
                       std::vector<std::uint8_t>& mask) {
  const std::vector<Piece> all = pieces();
  std::vector<std::uint8_t> picked(all.size(), 0);
  for (std::size_t run = 0; run < all.size(); ++run) picked[run] = all[run].voxels > 0 && which(all[run]) ? 1 : 0;
  paint_roots(picked, value, mask);
}

void Components::keep_largest(std::vector<std::uint8_t>& mask) {
  const std::vector<Piece> all = pieces();
  if (all.empty()) return;
  std::vector<std::uint8_t> picked(all.size(), 1);
  picked[static_cast<std::size_t>(
      std::max_element(all.begin(), all.end(), [](const Piece& a, const Piece& b) { return a.voxels < b.voxels; }) -
      all.begin())] = 0;
  paint_roots(picked, 0, mask);
}

}  // namespace seldinger::volume
