// The body: largest 3-D component (6-neighbours) above a threshold, interior air filled per axial slice
// (docs/clinical.md, "Body and patient"). Where the field of view cuts the body, lung, bowel and airways behind the
// cut are inside (docs/decisions/0060).
#pragma once

#include <cstdint>
#include <vector>

#include "sim/volume/volume.h"

namespace seldinger::volume {

constexpr int kSkinHu = -300;  // docs/clinical.md, "Body and patient"

// One byte per voxel, 1 = body. Empty body (nothing above the threshold): all 0.
std::vector<std::uint8_t> body_mask(const Volume& volume, int threshold_hu = kSkinHu);

// As it was before cuts were told: whatever air reaches the edge of its slice is the room's.
std::vector<std::uint8_t> body_mask_by_rule_1(const Volume& volume, int threshold_hu = kSkinHu);

}  // namespace seldinger::volume
