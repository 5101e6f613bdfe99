// From a CT as it came to a case's volume and skin: clamped, denoised, shrunk, the skin cut out, smoothed and
// decimated; and how far that is from the CT as it came (docs/decisions/0080).
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "casedb/cases/preparation.h"
#include "sim/base/result.h"
#include "sim/case/form/mesh.h"
#include "sim/case/form/mesh_index.h"
#include "sim/volume/volume.h"

namespace seldinger::casedb {

// Blocks of `factors` voxels (each ≥ 1) averaged into one; what does not fill a block at the far end is left out.
// Each factor is at most the volume's size there (CHECKed).
volume::Volume shrunk(const volume::Volume& volume, const glm::ivec3& factors);

struct Prepared {
  volume::Volume volume;
  cases::Mesh skin;
  double decimated = 0.0;  // share of the skin's triangles that could be taken away: more would have opened it
  std::vector<base::Problem> warnings;  // `denoised`, `cut_body`
};

// Refused: `bad_preparation` (settings out of bounds, voxels of more than 10 mm, fewer than three along an axis),
// `no_body`. As it is, the volume as it came and skin_surface() of it, bit for bit.
base::Result<Prepared> prepare(volume::Volume original, const Preparation& preparation);

// The surface of a CT at its own resolution, neither smoothed nor decimated.
struct FullSurface {
  cases::Mesh mesh;
  cases::MeshIndex index;
};
base::Result<FullSurface> full_surface(const volume::Volume& original, double skin_hu);  // `no_body`

// What the preparation cost. Distances between both surfaces, from each to the other, caps where the CT ends aside;
// differences of HU at voxels of the original that are no air.
struct Fidelity {
  bool compares_skin = false;  // else both are caps alone, and there are no distances
  double mean_mm = 0.0, most_95_mm = 0.0, most_mm = 0.0;
  double mean_hu = 0.0, most_95_hu = 0.0;
  std::size_t triangles = 0, full_triangles = 0;
  double decimated = 0.0;  // as of Prepared
};
Fidelity fidelity_of(const volume::Volume& original, const FullSurface& full, const Prepared& prepared);
std::string text_of(const Fidelity& fidelity);
// Where much less was taken away than was asked for, why; else nothing.
std::string less_decimated(const Preparation& preparation, const Fidelity& fidelity);

// What a mentor is told of a preparation, `prepared`.
base::Problem told_of(const Preparation& preparation, const Prepared& prepared, const Fidelity& fidelity);

}  // namespace seldinger::casedb
