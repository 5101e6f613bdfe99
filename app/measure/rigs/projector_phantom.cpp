#include "app/measure/rigs/projector_phantom.h"

#include <cmath>

#include "sim/base/rng.h"
#include "sim/volume/analytic.h"

namespace seldinger::measure {

volume::Volume make_projector_phantom() {
  constexpr int kAir = -1000;
  constexpr std::uint64_t kSeed = 62;
  volume::AnalyticVolume analytic;
  analytic.size_voxels = {514, 514, 64};
  analytic.spacing_mm = {0.74, 0.74, 3.0};
  analytic.origin_mm = -0.5 * glm::dvec3(analytic.size_voxels - 1) * analytic.spacing_mm;
  analytic.background_hu = kAir;
  analytic.shapes = {{volume::Cylinder{{0.0, 0.0, -93.0}, {0.0, 0.0, 93.0}, 150.0}, 0.0},
                     {volume::Sphere{{0.0, 90.0, 0.0}, 25.0}, 700.0},
                     {volume::Sphere{{80.0, 0.0, 30.0}, 20.0}, 900.0},
                     {volume::Sphere{{-80.0, 0.0, -30.0}, 20.0}, 1100.0},
                     {volume::Sphere{{40.0, -70.0, 40.0}, 15.0}, 1300.0},
                     {volume::Sphere{{-40.0, -70.0, -40.0}, 30.0}, 1500.0}};
  volume::Volume phantom = volume::rasterize(analytic);
  for (std::size_t i = 0; i < phantom.hu.size(); ++i)
    if (phantom.hu[i] != kAir)
      phantom.hu[i] =
          static_cast<std::int16_t>(phantom.hu[i] + static_cast<int>(base::uniform_at(kSeed, i) * 21.0) - 10);
  return phantom;
}

}  // namespace seldinger::measure
