// A projection with larger pixels, brought back to the full picture: less time for less sharpness.
#pragma once

#include "sim/imaging/xray/projection.h"

namespace seldinger::imaging {

// One pixel for `by` × `by` of `geometry`, over the same field. width_px and height_px are multiples of `by`
// (CHECK).
XrayGeometry coarser(XrayGeometry geometry, int by);

// The lengths of coarser(geometry, by) at the pixels of `geometry`, bilinear between the coarse pixels' centres.
PathLengths enlarged(const PathLengths& coarse, int by);

}  // namespace seldinger::imaging
