// A volume's mask seen slice by slice, across the voxel axis nearest to the patient's head-foot axis.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <vector>

#include "sim/volume/volume.h"

namespace seldinger::volume {

class AxialSlices {
 public:
  explicit AxialSlices(const Volume& volume);

  int count() const noexcept { return count_; }
  int width() const noexcept { return width_; }
  int height() const noexcept { return height_; }
  glm::dvec2 spacing_mm() const noexcept { return spacing_mm_; }
  std::size_t voxel(int slice, int x, int y) const noexcept {
    return static_cast<std::size_t>(slice) * step_slice_ + static_cast<std::size_t>(x) * step_x_ +
           static_cast<std::size_t>(y) * step_y_;
  }

 private:
  int count_ = 0, width_ = 0, height_ = 0;
  glm::dvec2 spacing_mm_{0.0};
  std::size_t step_slice_ = 0, step_x_ = 0, step_y_ = 0;
};

// Whatever the background of a slice's border does not reach (4 neighbours) becomes body.
void fill_slices(const AxialSlices& slices, std::vector<std::uint8_t>& mask);

// In a slice of width x height bytes: voxels within `radius` (a box) of one of `value` get it. Beyond the slice's
// edge there is neither.
void grow_slice(std::vector<std::uint8_t>& slice, int width, int height, glm::ivec2 radius, std::uint8_t value,
                std::vector<int>& scratch);

// The voxels of the mask that a square of 2·radius + 1 voxels cannot cover within it, not even with its edge one
// voxel off: thin sheets and threads. Beyond the slice's edge the mask is taken to go on.
std::vector<std::uint8_t> thin_parts(const AxialSlices& slices, const std::vector<std::uint8_t>& mask,
                                     glm::ivec2 radius_voxels);

}  // namespace seldinger::volume
