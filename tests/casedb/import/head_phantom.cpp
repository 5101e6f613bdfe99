#include "tests/casedb/import/head_phantom.h"

#include <cmath>
#include <glm/common.hpp>
#include <glm/matrix.hpp>
#include <limits>

#include "sim/base/rng.h"

namespace seldinger::casedb {
namespace {

using volume::Box, volume::Cylinder, volume::Ellipsoid, volume::Shape, volume::Sphere;

const std::vector<Shape>& shapes() {
  static const std::vector<Shape> all = {
      {Cylinder{{0, 15, -40}, {0, 15, -220}, 58}, 45},   // neck
      {Ellipsoid{{0, 20, -245}, {200, 85, 60}}, 40},     // shoulders
      {Ellipsoid{{0, 5, 20}, {77, 97, 105}}, 40},        // scalp
      {Ellipsoid{{0, -45, -45}, {62, 58, 75}}, 40},      // face
      {Ellipsoid{{0, -106, -30}, {14, 18, 22}}, 40},     // nose
      {Ellipsoid{{0, 5, 20}, {71, 91, 98}}, 900},        // skull
      {Ellipsoid{{0, 5, 20}, {65, 85, 92}}, 35},         // brain
      {Cylinder{{0, 35, -55}, {0, 35, -220}, 17}, 600},  // spine
      {Sphere{{32, -70, -15}, 19}, 800},
      {Sphere{{-32, -70, -15}, 19}, 800},  // orbits: bone, fat, eye
      {Sphere{{32, -74, -15}, 17}, -80},
      {Sphere{{-32, -74, -15}, 17}, -80},
      {Sphere{{32, -82, -15}, 12}, 10},
      {Sphere{{-32, -82, -15}, 12}, 10},
      {Ellipsoid{{0, -70, -58}, {36, 26, 14}}, 700},  // upper jaw
      {Box{{-11, -100, -55}, {11, -50, -20}}, 800},   // nasal cavity in its bone
      {Box{{-8, -100, -52}, {8, -55, -25}}, -950},    // nasal cavity
      {Ellipsoid{{0, -50, -97}, {50, 47, 16}}, 900},  // mandible
      {Ellipsoid{{0, -40, -97}, {41, 44, 20}}, 45},   // floor of the mouth
      {Box{{42, -45, -100}, {52, -20, -50}}, 800},    // its branches
      {Box{{-52, -45, -100}, {-42, -20, -50}}, 800},
      {Ellipsoid{{0, -76, -76}, {30, 16, 7}}, 2200},       // teeth
      {Ellipsoid{{0, -66, -76}, {22, 16, 8}}, 45},         // tongue
      {Cylinder{{0, -30, -45}, {0, -25, -220}, 9}, -950},  // pharynx
  };
  return all;
}

// Drawn once, in the head's frame, finer than any view of it.
const volume::Volume& drawn() {
  static const volume::Volume volume =
      volume::rasterize({{130, 145, 215}, glm::dvec3(2.0), {-129, -139, -289}, -1000.0, shapes()});
  return volume;
}

double hu_at(const glm::dvec3& p) {
  const glm::dvec3 index = (p - glm::dvec3(-129, -139, -289)) / 2.0;
  return volume::sample_nearest(drawn(), index).value_or(-1000);
}

}  // namespace

volume::Volume head_volume(const HeadView& view) {
  // The box of the field, along the voxel axes.
  const glm::dmat3 axes_from_lps = glm::transpose(view.direction);
  glm::dvec3 low(std::numeric_limits<double>::infinity()), high = -low;
  for (int corner = 0; corner < 8; ++corner) {
    const glm::dvec3 p((corner & 1) != 0 ? view.half_width_mm : -view.half_width_mm,
                       (corner & 2) != 0 ? view.half_width_mm : -view.half_width_mm - 10.0,
                       (corner & 4) != 0 ? view.to_z_mm : view.from_z_mm);
    low = glm::min(low, axes_from_lps * p);
    high = glm::max(high, axes_from_lps * p);
  }
  const glm::ivec3 size = glm::max(glm::ivec3(1), glm::ivec3((high - low) / view.spacing_mm));
  volume::Volume made =
      volume::make_volume(size, view.spacing_mm, view.direction, view.direction * (low + view.spacing_mm / 2.0));
  const glm::dmat3 head_from_lps = glm::transpose(view.lps_from_head);
  base::Rng rng(11);
  std::size_t voxel = 0;
  for (int k = 0; k < size.z; ++k)
    for (int j = 0; j < size.y; ++j)
      for (int i = 0; i < size.x; ++i, ++voxel) {
        const glm::dvec3 lps(made.lps_from_voxel * glm::dvec4(i, j, k, 1.0));
        if (lps.z < view.from_z_mm || lps.z > view.to_z_mm) continue;
        const double noise = view.noise_sd_hu > 0.0 ? view.noise_sd_hu * rng.normal() : 0.0;
        made.hu[voxel] =
            static_cast<std::int16_t>(std::lround(glm::clamp(hu_at(head_from_lps * lps) + noise, -1024.0, 3071.0)));
      }
  return made;
}

}  // namespace seldinger::casedb
