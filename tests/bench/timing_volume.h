// The volume on which projectors are timed, ours and the peer's. 512×512×62 voxels of 0.74×0.74×3 mm centred at the
// origin: air (−1000 HU), a water cylinder of 150 mm radius along z, five bone spheres. All that is not air carries
// noise, uniform in ±10 HU: of uniform cells a projector could take many in one step, of a patient's it cannot. One
// voxel of air all around (514×514×64), because the peer leaves out the last voxel of every ray.
#pragma once

#include "sim/volume/volume.h"

namespace seldinger::bench {

volume::Volume timing_volume();

}  // namespace seldinger::bench
