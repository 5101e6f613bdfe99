// Projections with larger or smaller pixels than the picture's: larger ones are brought back by interpolation, for
// less time; smaller ones by their mean, since a pixel sees its whole area: what repeats faster than pixels then
// averages out and does not turn into stripes (aliasing).
#pragma once

#include "sim/imaging/xray/projection/projection.h"

namespace seldinger::imaging {

// One pixel for `by` × `by` of `geometry`, over the same field. width_px and height_px are multiples of `by`
// (CHECK).
XrayGeometry coarser(XrayGeometry geometry, int by);

// The lengths of coarser(geometry, by) at the pixels of `geometry`, bilinear between the coarse pixels' centres.
PathLengths enlarged(const PathLengths& coarse, int by);

// `by` × `by` pixels for one, over the same field.
XrayGeometry finer(XrayGeometry geometry, int by);

// The mean lengths of each `by` × `by` pixels of finer(geometry, by).
PathLengths averaged(const PathLengths& fine, int by);

}  // namespace seldinger::imaging
