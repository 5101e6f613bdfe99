// Volumes, planes and inserted shapes for the tests of MPR.
#pragma once

#include <glm/mat3x3.hpp>

#include "sim/base/rng.h"
#include "sim/imaging/mpr/mpr.h"
#include "tests/sim/imaging/image_comparison.h"

namespace seldinger::imaging {

glm::dvec3 random_direction(base::Rng& rng);
glm::dmat3 random_rotation(base::Rng& rng);

// Every voxel independent and uniform in −1024 … 3071 HU: the hardest volume for a sampler. Its centre is at
// `center_lps_mm`.
volume::Volume noise_volume(glm::ivec3 size_voxels, glm::dvec3 spacing_mm, const glm::dmat3& direction,
                            glm::dvec3 center_lps_mm, std::uint64_t seed);

// An oblique plane in any direction through the neighbourhood of a point.
MprView random_view(base::Rng& rng, glm::dvec3 near_lps_mm, double spread_mm, double pixel_mm, int width_px,
                    int height_px, Interpolation interpolation);

glm::dvec3 pixel_lps_mm(const MprView& view, int column, int row);

// Pixels where moving the edge of any shape by `edge_mm` changes what is shown: there rounding may decide.
PixelMask near_shape_edges(const MprView& view, const Inserted& inserted, double edge_mm);

// Pixels within `voxels` of a face of the volume and, with nearest, of a tie between two voxels.
PixelMask near_voxel_faces(const volume::Volume& volume, const MprView& view, double voxels);

PixelMask either(const PixelMask& a, const PixelMask& b);

// The two ways on the CPU.
using Backend = HuImage (*)(const volume::Volume&, const MprView&, const Inserted&);

struct NamedBackend {
  const char* name;
  Backend render;
};
inline constexpr NamedBackend kBackends[] = {{"reference", mpr_reference}, {"cpu", mpr_cpu}};

}  // namespace seldinger::imaging
