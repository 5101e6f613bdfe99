// Noise out of a CT, edges kept: anisotropic diffusion (Perona and Malik, IEEE TPAMI 12 (1990) 629; by curvature,
// Whitaker and Xue, ICIP 2001), by ITK.
#pragma once

#include "sim/base/result.h"
#include "sim/volume/volume.h"

namespace seldinger::casedb {

struct DiffusionOptions {
  int iterations = 5;
  double conductance = 2.0;  // in units of the mean gradient; less keeps weaker edges
};

// The longest step that is stable in three dimensions: the smallest spacing / 2⁴, less a tenth (ITK's own bound,
// which takes no spacing for more than 1 mm).
double stable_step(const volume::Volume& volume);

// The standard deviation of noise in soft tissue, HU: the median over bodies' voxels (−100 to 200 HU) of the
// absolute second difference along i, by √6 · 0.6745 (Olsen, CVGIP 55 (1993) 319, of a robust form). 0 without any.
double noise_sd_hu(const volume::Volume& volume);

// The volume with what it holds diffused; HU below −1024 do not arise. Takes 8 bytes a voxel on top.
volume::Volume diffused(const volume::Volume& volume, const DiffusionOptions& options = {});

// Diffuses it in place so many times; what a mentor is told of that, `denoised`.
base::Problem denoise(volume::Volume& volume, int iterations);

}  // namespace seldinger::casedb
