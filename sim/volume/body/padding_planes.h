// Planes behind which a CT holds nothing: an oblique crop, or a face that was taken away.
#pragma once

#include <cstdint>
#include <vector>

#include "sim/volume/volume.h"

namespace seldinger::volume {

// Sets the voxels of `fill` behind such planes in `padding` (sized as the volume, 0 or 1) and tells whether there
// are any. A plane is one where tissue ends from one voxel to the next in `fill` through and through, over more
// than 10 cm². Where most of the body ends so, a program has taken the room away, and what is left is skin: no
// plane.
bool add_padding_planes(const Volume& volume, std::int16_t fill, std::vector<std::uint8_t>& padding);

}  // namespace seldinger::volume
