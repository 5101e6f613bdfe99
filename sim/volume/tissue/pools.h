// Pools: bright and even regions that are thick, and what drains into them. Blood, organs and cartilage full of
// contrast are pools, and so is the spongy inside of a bone: its rim tells it. Inside sim/volume/tissue only.
#pragma once

#include <cstdint>
#include <vector>

#include "sim/volume/classes.h"

namespace seldinger::volume {

constexpr int kAboveSpongyHu = 300;  // trabecular bone of the young reaches 250

struct Pool {
  int level_hu = 0;        // median of its even inside
  std::size_t inner = 0;   // voxels of it
  double rim_share = 0.0;  // of directions that meet something brighter, and no other contrast, before it ends
  bool spongy = false;     // held by a rim on most sides
  bool marrow = false;     // spongy, or as dense as cortex
};

struct Pools {
  std::vector<std::uint16_t> of;   // per voxel: 0 none, else 1 + index
  std::vector<std::uint8_t> core;  // per voxel: 1 in a pool's even inside
  std::vector<Pool> pools;

  // In a pool that is no marrow.
  bool enhanced(std::size_t at) const noexcept { return of[at] != 0 && !pools[of[at] - 1U].marrow; }
};

// Voxels as large as a rib is thick: few are of one tissue, and what noise does to them and what tissue does are
// hard to part.
bool is_coarse(const Volume& volume) noexcept;

// HU less noise: over [1 2 1] x [1 2 1] where voxels are fine, as they are where partial volume has averaged
// already.
struct Smooth {
  std::vector<std::int16_t> hu;
  double noise_sd_hu = 0.0;  // what is left of it
};
Smooth smooth_of(const Volume& volume, const std::vector<TissueClass>& classes);

Pools find_pools(const Volume& volume, const Smooth& smooth, const std::vector<TissueClass>& classes);

}  // namespace seldinger::volume
