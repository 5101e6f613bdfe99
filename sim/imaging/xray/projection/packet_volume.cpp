#include "sim/imaging/xray/projection/packet_volume.h"

#include <algorithm>

#include "sim/imaging/xray/projection/attenuating_box.h"

namespace seldinger::imaging {
PacketVolume::PacketVolume(const volume::Volume& volume) {
  const VoxelBox tight = attenuating_box(volume);
  if (tight.empty()) return;
  const VoxelBox box = grown(tight, volume.size_voxels);
  low = box.low;
  size = box.size();
  x_fastest_.stride = {1, size.x, size.x * size.y};
  // A ray's index may round one voxel beyond a face, at weight 0 or nearly; it must still be ours to read.
  margin = 2 * (std::ptrdiff_t{1} + std::max(size.x, size.y) + std::ptrdiff_t{size.x} * size.y) + 64;
  x_fastest_.values.assign(
      static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y) * static_cast<std::size_t>(size.z) +
          2 * static_cast<std::size_t>(margin),
      0);
  constexpr int kCell = 1 << kCellShift;
  cells = (size + (kCell - 1)) / kCell;
  const glm::ivec3 n = cells + 1;
  occupied_before.assign(static_cast<std::size_t>(n.x) * n.y * n.z, 0);
  const auto before = [&](int i, int j, int k) -> std::int32_t& {
    return occupied_before[(static_cast<std::size_t>(k) * n.y + j) * n.x + i];
  };
  std::uint16_t* out = x_fastest_.values.data() + margin;
  for (int k = 0; k < size.z; ++k)
    for (int j = 0; j < size.y; ++j, out += size.x) {
      const std::int16_t* in = volume.hu.data() + volume.index(low.x, low.y + j, low.z + k);
      for (int i = 0; i < size.x; ++i) out[i] = static_cast<std::uint16_t>(std::max(0, in[i] - kNothingHu));
      for (int cell = 0; cell < cells.x; ++cell) {
        const std::uint16_t* from = out + cell * kCell;
        const std::uint16_t* to = out + std::min(size.x, (cell + 1) * kCell);
        if (std::any_of(from, to, [](std::uint16_t value) { return value != 0; }))
          before(cell + 1, (j >> kCellShift) + 1, (k >> kCellShift) + 1) = 1;
      }
    }
  for (int k = 1; k < n.z; ++k)
    for (int j = 1; j < n.y; ++j)
      for (int i = 1; i < n.x; ++i)
        before(i, j, k) += before(i - 1, j, k) + before(i, j - 1, k) + before(i, j, k - 1) -
                           before(i - 1, j - 1, k) - before(i - 1, j, k - 1) - before(i, j - 1, k - 1) +
                           before(i - 1, j - 1, k - 1);
}

const PacketVolume::Order& PacketVolume::order_for(int main_axis) const {
  if (main_axis != 0) return x_fastest_;
  std::call_once(y_fastest_made_, [this] {
    y_fastest_.stride = {size.y, 1, size.x * size.y};
    y_fastest_.values.assign(x_fastest_.values.size(), 0);
    // In squares that fit the nearest cache.
    constexpr int kSquare = 32;
    for (int k = 0; k < size.z; ++k) {
      const std::uint16_t* in = first(x_fastest_) + std::ptrdiff_t{k} * x_fastest_.stride.z;
      std::uint16_t* out = y_fastest_.values.data() + margin + std::ptrdiff_t{k} * y_fastest_.stride.z;
      for (int j0 = 0; j0 < size.y; j0 += kSquare)
        for (int i0 = 0; i0 < size.x; i0 += kSquare)
          for (int i = i0; i < std::min(size.x, i0 + kSquare); ++i)
            for (int j = j0; j < std::min(size.y, j0 + kSquare); ++j)
              out[std::ptrdiff_t{i} * size.y + j] = in[std::ptrdiff_t{j} * size.x + i];
    }
  });
  return y_fastest_;
}

std::size_t PacketVolume::bytes() const noexcept {
  return (x_fastest_.values.size() + y_fastest_.values.size()) * sizeof(std::uint16_t) +
         occupied_before.size() * sizeof(std::int32_t);
}

bool PacketVolume::any_in(const glm::ivec3& low_voxel, const glm::ivec3& high_voxel) const noexcept {
  const glm::ivec3 a = glm::max(low_voxel, 0) >> kCellShift;
  const glm::ivec3 b = (glm::min(high_voxel, size - 1) >> kCellShift) + 1;
  if (b.x <= a.x || b.y <= a.y || b.z <= a.z) return false;
  const glm::ivec3 n = cells + 1;
  const auto before = [&](int i, int j, int k) {
    return occupied_before[(static_cast<std::size_t>(k) * n.y + j) * n.x + i];
  };
  return before(b.x, b.y, b.z) - before(a.x, b.y, b.z) - before(b.x, a.y, b.z) - before(b.x, b.y, a.z) +
             before(a.x, a.y, b.z) + before(a.x, b.y, a.z) + before(b.x, a.y, a.z) - before(a.x, a.y, a.z) !=
         0;
}

}  // namespace seldinger::imaging
