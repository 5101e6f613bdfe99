// The skin as a closed triangle mesh: the iso-surface of the body mask. The door of VTK.
#pragma once

#include <optional>

#include "sim/base/result.h"
#include "sim/case/form/mesh.h"
#include "sim/volume/volume.h"

namespace seldinger::casedb {

struct SurfaceOptions {
  int iso_hu = -300;
  double target_spacing_mm = 1.8;  // voxels are averaged together up to about this
  double decimate_share = 0.7;     // of the triangles taken away, topology kept
  int smoothing_iterations = 15;   // windowed sinc (Taubin, ECCV 1996): does not shrink
};

// Clamp, shrink, pad with one voxel of air, iso-surface, smooth, decimate, outward normals; closed where the volume
// ends or what lies beyond the reconstruction's circle begins, those caps marked cut. Smoothed first: on decimated
// triangles of every size it goes astray by millimetres. Refused: `no_body`.
// Where taking away as much would open the skin less is taken away: `taken_share`, where it is asked for, says how
// much.
base::Result<cases::Mesh> skin_surface(const volume::Volume& volume, const SurfaceOptions& options = {},
                                       double* taken_share = nullptr);

// The warning `cut_body` of a skin that ends at more than the patient's head and feet: where, and how much is skin.
std::optional<base::Problem> cut_body(const cases::Mesh& skin, const volume::Volume& volume);

}  // namespace seldinger::casedb
