// The body: largest 3-D component (6-neighbours) above a threshold, interior air filled per axial slice
// (contracts.md).
#pragma once

#include <cstdint>
#include <vector>

#include "sim/volume/volume.h"

namespace seldinger::volume {

constexpr int kSkinHu = -300;  // contracts.md, clinical.md

// One byte per voxel, 1 = body. Empty body (nothing above the threshold): all 0.
std::vector<std::uint8_t> body_mask(const Volume& volume, int threshold_hu = kSkinHu);

}  // namespace seldinger::volume
