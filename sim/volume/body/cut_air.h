// Air at the edge of the field of view, slice by slice: the room's, or lung and gas of a body that the edge cuts.
#pragma once

#include <cstdint>
#include <vector>

#include "sim/volume/axial_slices.h"
#include "sim/volume/volume.h"

namespace seldinger::volume {

// One byte per voxel, 1 = air or lung that reaches the edge of its slice, or padding, and is the body's. `tissue`:
// what is dense; `body`: the part of it that is known to be body; `padding`: as padding_of, may be empty.
//
// A piece of air lies along the edge from one piece of tissue to the next. Outside a body the line between these
// two ends leads through tissue; inside, where the edge cuts a lung or a bowel, it leads through the air itself.
// Where most of a piece lies between that line and the edge, it lies along a body and not in it; what is thin as
// gas and turns round a corner of the field is the room's. Pieces of neighbouring slices that overlap vote
// together; where they are a nook between thighs, or neck and shoulder, that opens to an end of the CT, they are
// the room's whatever their votes. What is as dense as lung is lung but for a clear vote against.
std::vector<std::uint8_t> air_cut_by_edge(const Volume& volume, const AxialSlices& slices,
                                          const std::vector<std::uint8_t>& tissue,
                                          const std::vector<std::uint8_t>& body,
                                          const std::vector<std::uint8_t>& padding);

}  // namespace seldinger::volume
