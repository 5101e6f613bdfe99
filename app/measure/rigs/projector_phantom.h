// The volume on which projectors are timed: 512×512×62 voxels of 0.74×0.74×3 mm centred at the origin, a water
// cylinder of 150 mm radius along z with five bone spheres in air, and one voxel of air all around (a peer leaves
// out the last voxel of every ray). All that is not air carries noise, uniform in ±10 HU: of uniform cells a
// projector could take many in one step, of a patient's it cannot.
#pragma once

#include "sim/volume/volume.h"

namespace seldinger::measure {

volume::Volume make_projector_phantom();

}  // namespace seldinger::measure
