// The connected pieces (6 neighbours) of a mask, as runs of voxels joined by union-find.
#pragma once

#include <cstdint>
#include <functional>
#include <glm/vec3.hpp>
#include <vector>

namespace seldinger::volume {

struct Piece {
  std::size_t voxels = 0;
  glm::ivec3 low{0}, high{0};  // the box around it, both inclusive
};

class Components {
 public:
  Components(glm::ivec3 size_voxels, const std::vector<std::uint8_t>& mask);

  // Sets the voxels of every piece that `which` picks to `value`; other voxels stay.
  void paint(const std::function<bool(const Piece&)>& which, std::uint8_t value, std::vector<std::uint8_t>& mask);
  // Leaves in the mask (the one these are the pieces of) nothing but the piece with the most voxels.
  void keep_largest(std::vector<std::uint8_t>& mask);

  // Numbers of pieces are below this.
  std::size_t numbers() const noexcept { return runs_.size(); }
  // Calls visit(number of its piece, first voxel, voxel past the last) for every run, in the order of the voxels.
  template <typename Visit>
  void each_run(const Visit& visit) {
    for (std::size_t row = 0; row < rows(); ++row)
      for (std::uint32_t run = row_first_[row]; run < row_first_[row + 1]; ++run) {
        const std::size_t start = row * static_cast<std::size_t>(size_.x);
        visit(std::size_t{root(run)}, start + static_cast<std::size_t>(runs_[run].begin),
              start + static_cast<std::size_t>(runs_[run].end));
      }
  }

 private:
  struct Run {  // [begin, end) of a row
    int begin, end;
    std::uint32_t parent;
  };
  std::size_t rows() const noexcept {
    return static_cast<std::size_t>(size_.y) * static_cast<std::size_t>(size_.z);
  }
  std::uint32_t root(std::uint32_t run);
  void join_rows(std::size_t before, std::size_t row);
  std::vector<Piece> pieces();  // at the index of a piece's root run
  void paint_roots(const std::vector<std::uint8_t>& picked, std::uint8_t value, std::vector<std::uint8_t>& mask);

  glm::ivec3 size_;
  std::vector<Run> runs_;
  std::vector<std::uint32_t> row_first_;
};

}  // namespace seldinger::volume
