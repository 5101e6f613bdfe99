// The body: largest 3-D component (6-neighbours) above a threshold, interior air filled per axial slice
// (docs/clinical.md, "Body and patient").
#pragma once

#include <cstdint>
#include <vector>

#include "sim/volume/volume.h"

namespace seldinger::volume {

constexpr int kSkinHu = -300;  // docs/clinical.md, "Body and patient"

// One byte per voxel, 1 = body. Empty body (nothing above the threshold): all 0.
std::vector<std::uint8_t> body_mask(const Volume& volume, int threshold_hu = kSkinHu);

}  // namespace seldinger::volume
