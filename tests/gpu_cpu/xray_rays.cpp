#include "tests/gpu_cpu/xray_rays.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <limits>
#include <vector>

#include "tests/sim/imaging/mpr_scene.h"

namespace seldinger::imaging {
namespace {

constexpr double kMedianRelative = 5e-6, kMostRelative = 1e-4, kLeastNepers = 0.05, kMostNepers = 2e-4;

bool of_two_main_axes(const volume::Volume& volume, const RaySegment& ray) {
  const glm::dvec3 along = glm::abs(glm::dmat3(volume::voxel_from_lps(volume)) * (ray.to_lps_mm - ray.from_lps_mm));
  std::array<double, 3> steep{along.x, along.y, along.z};
  std::sort(steep.begin(), steep.end());
  return steep[1] > (1.0 - 1e-9) * steep[2];
}

}  // namespace

XrayGeometry rays_from(const glm::dvec3& source_lps_mm, const glm::dvec3& center_lps_mm, const glm::dvec3& u,
                       const glm::dvec3& v, double pixel_mm, int width_px, int height_px) {
  XrayGeometry geometry;
  geometry.source_lps_mm = source_lps_mm;
  geometry.detector_center_lps_mm = center_lps_mm;
  geometry.u = u;
  geometry.v = v;
  geometry.pixel_mm = pixel_mm;
  geometry.width_px = width_px;
  geometry.height_px = height_px;
  return geometry;
}

XrayGeometry parallel_rays(const glm::dvec3& direction, const glm::dvec3& center_lps_mm, const glm::dvec3& u,
                           const glm::dvec3& v, double pixel_mm, int width_px, int height_px) {
  XrayGeometry geometry = rays_from(glm::dvec3(0.0), center_lps_mm, u, v, pixel_mm, width_px, height_px);
  geometry.source_lps_mm.reset();
  geometry.direction = direction;
  return geometry;
}

XrayGeometry one_ray(const glm::dvec3& from_lps_mm, const glm::dvec3& to_lps_mm) {
  const glm::dvec3 along = glm::normalize(to_lps_mm - from_lps_mm);
  const glm::dvec3 u = glm::normalize(
      glm::cross(along, std::abs(along.x) < 0.9 ? glm::dvec3(1.0, 0.0, 0.0) : glm::dvec3(0.0, 1.0, 0.0)));
  return rays_from(from_lps_mm, to_lps_mm, u, glm::cross(along, u), 1.0, 1, 1);
}

XrayGeometry random_rays(base::Rng& rng, const glm::dvec3& near_lps_mm, double distance_mm, double pixel_mm,
                         int width_px, int height_px, bool parallel) {
  const glm::dmat3 turn = random_rotation(rng);
  const glm::dvec3 middle = near_lps_mm + 5.0 * random_direction(rng);
  const glm::dvec3 detector = middle + distance_mm * turn[2];
  return parallel
             ? parallel_rays(glm::normalize(turn[2] + 0.1 * turn[0]), detector, turn[0], turn[1], pixel_mm,
                             width_px, height_px)
             : rays_from(middle - distance_mm * turn[2], detector, turn[0], turn[1], pixel_mm, width_px, height_px);
}

double chord_mm(const volume::Volume& volume, const RaySegment& ray) {
  const glm::dmat4 voxel_from_lps = volume::voxel_from_lps(volume);
  const glm::dvec3 from(voxel_from_lps * glm::dvec4(ray.from_lps_mm, 1.0));
  const glm::dvec3 along = glm::dmat3(voxel_from_lps) * (ray.to_lps_mm - ray.from_lps_mm);
  double enter = 0.0, leave = 1.0;
  for (int axis = 0; axis < 3; ++axis) {
    const double low = -0.5 - from[axis], high = volume.size_voxels[axis] - 0.5 - from[axis];
    if (along[axis] == 0.0) {
      if (!(low <= 0.0 && 0.0 < high)) return 0.0;
      continue;
    }
    enter = std::max(enter, std::min(low / along[axis], high / along[axis]));
    leave = std::min(leave, std::max(low / along[axis], high / along[axis]));
  }
  return std::max(0.0, leave - enter) * glm::distance(ray.from_lps_mm, ray.to_lps_mm);
}

testing::AssertionResult is_the_reference(const PathLengths& picture, const volume::Volume& volume,
                                          const XrayGeometry& geometry, ProjectionMethod method) {
  const std::size_t pixels =
      static_cast<std::size_t>(geometry.width_px) * static_cast<std::size_t>(geometry.height_px);
  const bool apart = !picture.mineral_mm.empty();
  if (picture.width_px != geometry.width_px || picture.height_px != geometry.height_px ||
      picture.water_mm.size() != pixels || (apart && picture.mineral_mm.size() != pixels))
    return testing::AssertionFailure() << "wrong size";
  std::vector<double> relative;
  double most_nepers = 0.0;
  for (int row = 0; row < geometry.height_px; ++row)
    for (int column = 0; column < geometry.width_px; ++column) {
      const RaySegment ray = ray_of(geometry, volume, column, row);
      if (method == ProjectionMethod::slab && of_two_main_axes(volume, ray)) continue;
      const std::size_t at = static_cast<std::size_t>(row * geometry.width_px + column);
      const RayLengths expected = lengths_between(volume, ray.from_lps_mm, ray.to_lps_mm, method);
      const double water = picture.water_mm[at], mineral = apart ? picture.mineral_mm[at] : 0.0;
      const double nepers = kWaterPerMm * expected.total_mm();
      double off = kWaterPerMm * std::abs(water + mineral - expected.total_mm());
      if (nepers > kLeastNepers) relative.push_back(off / nepers);
      if (apart) off = std::max(off, kWaterPerMm * std::abs(water - expected.water_mm));
      if (!(off <= kMostNepers) || !(water >= 0.0) || !(mineral >= 0.0))  // NaN fails
        return testing::AssertionFailure()
               << "pixel " << column << ' ' << row << ": water " << water << " mm, mineral " << mineral
               << " mm instead of " << expected.water_mm << " and " << expected.mineral_mm;
      most_nepers = std::max(most_nepers, off);
    }
  if (relative.empty())
    return testing::AssertionSuccess() << "nothing above " << kLeastNepers << ", off by " << most_nepers
                                       << " nepers";
  std::sort(relative.begin(), relative.end());
  const double median = relative[relative.size() / 2], most = relative.back();
  const bool good = median <= kMedianRelative && most <= kMostRelative;
  return (good ? testing::AssertionSuccess() : testing::AssertionFailure())
         << "relative: median " << median << ", largest " << most << ", of " << relative.size()
         << " pixels; off by " << most_nepers << " nepers";
}

}  // namespace seldinger::imaging
