// MPR of a patient who moves: each pixel is what was where its tissue was at rest; of one who does not, nothing
// changes, to the bit.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "tests/sim/imaging/mpr_scene.h"

namespace seldinger::imaging {
namespace {

const glm::dvec3 kSkinLpsMm{4.0, -30.0, 700.0};

// A press into a body whose skin is the plane y = −30, a needle that drags, and a breath.
tissue::Displacement moving() {
  const tissue::SkinPress press{
      .at_lps_mm = kSkinLpsMm, .inward = {0.0, 1.0, 0.0}, .radius_mm = 20.0, .depth_mm = 8.0};
  const tissue::NeedleDrag needle{.entry_lps_mm = kSkinLpsMm + glm::dvec3(20.0, 0.0, 5.0),
                                  .direction = {0.0, 1.0, 0.0},
                                  .cut_mm = 30.0,
                                  .tip_n = 1.0,
                                  .tip_mm = 3.0,
                                  .shaft_mm = 2.0};
  const tissue::Breath breath{{.middle_x_mm = 0.0, .back_y_mm = 190.0, .dome_z_mm = 710.0}, {1.0, 6.0, 8.0}};
  return tissue::displacement_of({.presses = {&press, 1}, .needle = needle, .breath = breath});
}

MprView under_the_probe(Interpolation interpolation) {
  MprView view;
  view.center_lps_mm = kSkinLpsMm + glm::dvec3(0.0, 25.0, 0.0);
  view.u = {0.8, 0.0, 0.6};
  view.v = {0.0, 1.0, 0.0};
  view.pixel_mm = 0.5;
  view.width_px = 151;
  view.height_px = 117;
  view.interpolation = interpolation;
  return view;
}

Inserted lesion_and_needle() {
  Inserted inserted;
  inserted.lesions = {{kSkinLpsMm + glm::dvec3(3.0, 20.0, 2.0), 7.0, 333.0},
                      {kSkinLpsMm + glm::dvec3(-9.0, 24.0, -6.0), 8.0, 222.0}};
  inserted.needle = NeedlePose{.tip_lps_mm = kSkinLpsMm + glm::dvec3(8.0, 30.0, 6.0), .direction = {0.0, 1.0, 0.0}};
  return inserted;
}

TEST(MprDisplaced, OfAStillPatientIsTheSamePicture) {
  base::Rng rng(61);
  const volume::Volume volume = noise_volume({80, 70, 60}, {0.7, 0.9, 1.3}, random_rotation(rng), kSkinLpsMm, 13);
  const tissue::Displacement still = tissue::displacement_of({});
  for (const Interpolation interpolation : {Interpolation::linear, Interpolation::nearest})
    for (const double slab_mm : {0.0, 3.0}) {
      MprView view = under_the_probe(interpolation);
      view.needle_slab_mm = slab_mm;
      EXPECT_EQ(mpr_cpu(volume, view, lesion_and_needle(), still), mpr_cpu(volume, view, lesion_and_needle()));
      EXPECT_EQ(mpr_reference(volume, view, lesion_and_needle(), still),
                mpr_reference(volume, view, lesion_and_needle()));
    }
}

// In a linear ramp HU tell the place: each pixel's is the ramp at the place where its tissue was, asked for here
// from the other side: x of that place is the pixel's.
TEST(MprDisplaced, ShowsWhatWasWhereTheTissueWas) {
  volume::Volume volume = noise_volume({120, 110, 100}, glm::dvec3(1.5), glm::dmat3(1.0), kSkinLpsMm, 1);
  const tissue::Displacement displacement = moving();
  const MprView view = under_the_probe(Interpolation::linear);
  HuImage ramps[3];
  for (int axis = 0; axis < 3; ++axis) {
    for (int k = 0; k < 100; ++k)
      for (int j = 0; j < 110; ++j)
        for (int i = 0; i < 120; ++i)
          volume.hu[volume.index(i, j, k)] = static_cast<std::int16_t>(20 * glm::ivec3(i, j, k)[axis]);
    ramps[axis] = mpr_cpu(volume, view, {}, displacement);
  }
  double squares = 0.0, moved = 0.0;
  for (int row = 0; row < view.height_px; ++row)
    for (int column = 0; column < view.width_px; ++column) {
      const auto at = static_cast<std::size_t>(row * view.width_px + column);
      const glm::dvec3 index = glm::dvec3(ramps[0][at], ramps[1][at], ramps[2][at]) / 20.0;
      const glm::dvec3 rest_mm(volume.lps_from_voxel * glm::dvec4(index, 1.0));
      const glm::dvec3 pixel_mm = pixel_lps_mm(view, column, row);
      const double miss_mm = glm::length(tissue::displaced(displacement, rest_mm) - pixel_mm);
      squares += miss_mm * miss_mm;
      moved += glm::length(rest_mm - pixel_mm);
    }
  const double pixels = view.width_px * view.height_px;
  EXPECT_LT(std::sqrt(squares / pixels), 0.05) << "mm rms";
  EXPECT_GT(moved / pixels, 2.0) << "and it did move";
}

TEST(MprDisplaced, CpuIsReference) {
  volume::Volume volume = noise_volume({90, 80, 80}, glm::dvec3(1.6), glm::dmat3(1.0), kSkinLpsMm, 2);
  // Smooth, so that a hundredth of a mm is a hundredth of what a mm is.
  for (int k = 0; k < 80; ++k)
    for (int j = 0; j < 80; ++j)
      for (int i = 0; i < 90; ++i)
        volume.hu[volume.index(i, j, k)] =
            static_cast<std::int16_t>(300.0 * std::sin(0.21 * i) * std::cos(0.17 * j) + 2.0 * k);
  const tissue::Displacement displacement = moving();
  const MprView view = under_the_probe(Interpolation::linear);
  const Inserted inserted = lesion_and_needle();
  const HuImage cpu = mpr_cpu(volume, view, inserted, displacement);
  const HuImage reference = mpr_reference(volume, view, inserted, displacement);
  int apart = 0, lesion = 0;
  for (std::size_t i = 0; i < cpu.size(); ++i) {
    // 40 HU a mm at most: the grid's worst is 0.35 mm.
    apart += std::abs(cpu[i] - reference[i]) > 15.0F ? 1 : 0;
    lesion += reference[i] == 333.0F ? 1 : 0;
  }
  EXPECT_LE(apart, 40) << "on the edge of a lesion";
  EXPECT_GT(lesion, 100);
  // The lesion went with its tissue, the needle did not.
  const HuImage still = mpr_cpu(volume, view, inserted);
  int needle_moved = 0, lesion_moved = 0;
  for (std::size_t i = 0; i < cpu.size(); ++i) {
    needle_moved += (cpu[i] == 3000.0F) != (still[i] == 3000.0F) ? 1 : 0;
    lesion_moved += (cpu[i] == 333.0F) != (still[i] == 333.0F) ? 1 : 0;
  }
  EXPECT_EQ(needle_moved, 0);
  EXPECT_GT(lesion_moved, 50);
}

}  // namespace
}  // namespace seldinger::imaging
