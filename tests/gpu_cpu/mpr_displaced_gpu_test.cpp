// MPR of a patient who moves, on the GPU against the reference; and of one who does not, the picture it always was.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "tests/sim/imaging/mpr_scene.h"

namespace seldinger::imaging {
namespace {

const glm::dvec3 kSkinLpsMm{4.0, -30.0, 700.0};

tissue::Displacement moving() {
  const tissue::SkinPress press{.at_lps_mm = kSkinLpsMm,
                                .inward = {0.0, 1.0, 0.0},
                                .radius_mm = 20.0,
                                .depth_mm = 8.0,
                                .per_bone_mm = 1.0 / 45.0};
  const tissue::NeedleDrag needle{.entry_lps_mm = kSkinLpsMm + glm::dvec3(20.0, 0.0, 5.0),
                                  .direction = {0.0, 1.0, 0.0},
                                  .cut_mm = 30.0,
                                  .tip_n = 1.0,
                                  .tip_mm = 3.0,
                                  .shaft_mm = 2.0};
  const tissue::SqueezedVein vein{kSkinLpsMm + glm::dvec3(-15.0, 20.0, -50.0),
                                  kSkinLpsMm + glm::dvec3(-15.0, 20.0, 50.0), 5.0, 0.4};
  const tissue::Breath breath{{.middle_x_mm = 0.0, .back_y_mm = 190.0, .dome_z_mm = 710.0}, {1.0, 6.0, 8.0}};
  return tissue::displacement_of({.presses = {&press, 1}, .needle = needle, .veins = {&vein, 1}, .breath = breath});
}

struct Cut {
  volume::Volume volume;
  Inserted inserted;
  MprView view;
};
Cut cut() {
  Cut s{volume::make_volume({90, 80, 80}, glm::dvec3(1.6), glm::dmat3(1.0),
                            kSkinLpsMm - glm::dvec3(70.0, 60.0, 60.0)),
        {},
        {}};
  // Smooth, so that rounding is small in HU.
  for (int k = 0; k < 80; ++k)
    for (int j = 0; j < 80; ++j)
      for (int i = 0; i < 90; ++i)
        s.volume.hu[s.volume.index(i, j, k)] =
            static_cast<std::int16_t>(300.0 * std::sin(0.21 * i) * std::cos(0.17 * j) + 2.0 * k);
  s.inserted.lesions = {{kSkinLpsMm + glm::dvec3(3.0, 20.0, 2.0), 7.0, 333.0},
                        {kSkinLpsMm + glm::dvec3(-9.0, 24.0, -6.0), 8.0, 222.0}};
  s.inserted.needle =
      NeedlePose{.tip_lps_mm = kSkinLpsMm + glm::dvec3(8.0, 30.0, 6.0), .direction = {0.0, 1.0, 0.0}};
  s.view.center_lps_mm = kSkinLpsMm + glm::dvec3(0.0, 25.0, 0.0);
  s.view.u = {0.8, 0.0, 0.6};
  s.view.v = {0.0, 1.0, 0.0};
  s.view.pixel_mm = 0.31;
  s.view.width_px = 243;
  s.view.height_px = 189;
  return s;
}

// Pixels more than an HU apart.
int apart(const HuImage& a, const HuImage& b) {
  int n = 0;
  for (std::size_t i = 0; i < a.size(); ++i) n += std::abs(a[i] - b[i]) <= 1.0F ? 0 : 1;
  return n;
}

// Only where rounding decides may they differ: on the edges of lesions and needle.
TEST(MprDisplacedOnGpu, PixelByPixelIsTheReference) {
  const Cut s = cut();
  gpu::Context context;
  MprGpu gpu(context, s.volume, WayBack::each_pixel);
  const HuImage on_gpu = gpu.render(s.view, s.inserted, moving());
  EXPECT_LE(apart(on_gpu, mpr_reference(s.volume, s.view, s.inserted, moving())), 25) << "of " << on_gpu.size();
  EXPECT_NE(on_gpu, gpu.render(s.view, s.inserted)) << "and it did move";
}

TEST(MprDisplacedOnGpu, ByTheGridIsTheCpu) {
  const Cut s = cut();
  gpu::Context context;
  MprGpu gpu(context, s.volume, WayBack::grid);
  const HuImage on_gpu = gpu.render(s.view, s.inserted, moving());
  EXPECT_LE(apart(on_gpu, mpr_cpu(s.volume, s.view, s.inserted, moving())), 25) << "of " << on_gpu.size();
  EXPECT_NE(on_gpu, gpu.render(s.view, s.inserted)) << "and it did move";
}

TEST(MprDisplacedOnGpu, OfAStillPatientIsTheSamePicture) {
  const Cut s = cut();
  gpu::Context context;
  MprGpu still(context, s.volume), moves(context, s.volume, way_back_for(context));
  const HuImage expected = still.render(s.view, s.inserted);
  EXPECT_EQ(still.render(s.view, s.inserted, {}), expected);
  moves.render(s.view, s.inserted, moving());
  EXPECT_EQ(moves.render(s.view, s.inserted, {}), expected);
}

}  // namespace
}  // namespace seldinger::imaging
