// What packets of rays read: the part of the volume that attenuates, as max(0, 1000 + HU) in 16 bits, and which
// cells of it are empty. In two orders, so that for every main axis the neighbours along the first other axis lie
// side by side and are read in one access: x fastest, and for rays along x, y fastest (made when first needed).
// Inside sim/imaging/xray only.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <mutex>
#include <vector>

#include "sim/volume/volume.h"

namespace seldinger::imaging {

struct PacketVolume {
  explicit PacketVolume(const volume::Volume& volume);

  static constexpr int kCellShift = 3;  // a cell is 8 × 8 × 8 voxels

  glm::ivec3 low{0};   // first voxel of the kept box in the volume
  glm::ivec3 size{0};  // of the kept box; 0 when nothing attenuates
  struct Order {
    std::vector<std::uint16_t> values;  // with `margin` unused values before and after the box
    glm::ivec3 stride{0};
  };
  std::ptrdiff_t margin = 0;
  glm::ivec3 cells{0};
  std::vector<std::int32_t> occupied_before;  // number of occupied cells in [0,i)×[0,j)×[0,k), (cells + 1)³ of them

  const Order& order_for(int main_axis) const;  // on any thread
  const std::uint16_t* first(const Order& order) const noexcept { return order.values.data() + margin; }
  std::size_t bytes() const noexcept;
  // Whether any voxel in the box low … high (inclusive; clipped to the volume) attenuates.
  bool any_in(const glm::ivec3& low_voxel, const glm::ivec3& high_voxel) const noexcept;

 private:
  Order x_fastest_;
  mutable Order y_fastest_;
  mutable std::once_flag y_fastest_made_;
};

}  // namespace seldinger::imaging
