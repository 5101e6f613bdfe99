// Where a CT measured nothing: beyond the circle of its reconstruction, or behind a plane, a slice holds one value,
// which is no air.
#pragma once

#include <cstdint>
#include <vector>

#include "sim/volume/volume.h"

namespace seldinger::volume {

// One byte per voxel, 1 = beyond the circle, or behind a plane (padding_planes.h). Empty where the
// volume shows neither. What is there is kAirHu, or one value of air that a program filled it with while the CT's
// own air has noise. A circle: what is around it has that value in every slice, and its edge is one circle to
// within a voxel and a half (2 % of the radius where that is less). The outline of a round body in air of one value
// is none: padding is kAirHu, or some air was measured within.
std::vector<std::uint8_t> padding_of(const Volume& volume);

}  // namespace seldinger::volume
