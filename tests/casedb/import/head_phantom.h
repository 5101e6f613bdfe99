// A head with neck and shoulders from a few ellipsoids: skull and brain, nose with its cavity, eyes, jaws with
// teeth, pharynx, spine. Of nobody; its measures are a grown-up's (Farkas 1994). Millimetres in the head's own
// frame: x to its left, y to its back, z up, the middle of the skull near 0; the chin's bone ends at z = -113, its
// skin at -120, the brow is at 0, the top of the head at 125.
#pragma once

#include <glm/mat3x3.hpp>
#include <vector>

#include "sim/volume/analytic.h"
#include "sim/volume/volume.h"

namespace seldinger::casedb {

struct HeadView {
  glm::dmat3 lps_from_head{1.0};               // how the head lies
  glm::dmat3 direction{1.0};                   // columns: LPS directions of the voxel axes
  glm::dvec3 spacing_mm{2.5, 2.5, 3.0};        // along the voxel axes
  double from_z_mm = -200.0, to_z_mm = 140.0;  // the part that is scanned, of LPS z
  double half_width_mm = 130.0;                // of the field, around the axis
  double noise_sd_hu = 0.0;
};

volume::Volume head_volume(const HeadView& view);

}  // namespace seldinger::casedb
