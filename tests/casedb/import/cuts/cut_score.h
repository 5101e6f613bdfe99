// How the skin of a cropped CT compares with that of the whole patient.
#pragma once

#include "sim/case/form/mesh_index.h"
#include "sim/volume/volume.h"

namespace seldinger::casedb {

struct CutScore {
  std::size_t triangles = 0;
  double skin_mm2 = 0.0, cut_mm2 = 0.0;
  double false_skin_mm2 = 0.0;  // called skin, and farther than a voxel from the whole patient's
  double farthest_mm = 0.0;     // of what is called skin from the whole patient's
  double lost_share = 0.0;      // of the whole patient's skin within the field, 10 mm and more off its edge
};

// `field`: the cropped volume.
CutScore score_cut(const cases::Mesh& whole, const cases::MeshIndex& whole_index, const cases::Mesh& cut,
                   const volume::Volume& field);

}  // namespace seldinger::casedb
