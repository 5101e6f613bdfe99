// Pictures of X-ray projection for the tests: geometries, and comparison with the double reference.
#pragma once

#include <gtest/gtest.h>

#include "sim/base/rng.h"
#include "sim/imaging/xray/projection/projection.h"

namespace seldinger::imaging {

constexpr double kWaterPerMm = 0.018366;  // of water at 80 keV: path lengths to nepers (xraylib)

// A detector around `center`, its normal u × v.
XrayGeometry rays_from(const glm::dvec3& source_lps_mm, const glm::dvec3& center_lps_mm, const glm::dvec3& u,
                       const glm::dvec3& v, double pixel_mm, int width_px, int height_px);
XrayGeometry parallel_rays(const glm::dvec3& direction, const glm::dvec3& center_lps_mm, const glm::dvec3& u,
                           const glm::dvec3& v, double pixel_mm, int width_px, int height_px);

// One ray: a detector of one pixel across it.
XrayGeometry one_ray(const glm::dvec3& from_lps_mm, const glm::dvec3& to_lps_mm);

// From any side, source and detector at `distance_mm` about the point; every other one parallel.
XrayGeometry random_rays(base::Rng& rng, const glm::dvec3& near_lps_mm, double distance_mm, double pixel_mm,
                         int width_px, int height_px, bool parallel);

// Of homogeneous water, by three pairs of faces.
double chord_mm(const volume::Volume& volume, const RaySegment& ray);

// Of each pixel, water and mineral together: relative, median ≤ 5e-6 and largest ≤ 1e-4 where more than 0.05 nepers
// are absorbed; absolute ≤ 2e-4 nepers everywhere; never negative. Both planes apart within the absolute limit.
// Slab rays within 1e-9 of two main axes are left out: rounding may choose either.
testing::AssertionResult is_the_reference(const PathLengths& picture, const volume::Volume& volume,
                                          const XrayGeometry& geometry, ProjectionMethod method);

}  // namespace seldinger::imaging
