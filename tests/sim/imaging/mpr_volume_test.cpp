// The volume in an oblique plane: trilinear against a linear ramp, nearest against a search over all voxels, cpu
// against reference, and what lies outside.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "tests/sim/imaging/mpr_scene.h"

namespace seldinger::imaging {
namespace {

glm::dmat3 left_handed(const glm::dmat3& turn) {
  return {turn[0], turn[1], -turn[2]};
}

class MprVolume : public testing::TestWithParam<NamedBackend> {};

TEST_P(MprVolume, ShowsALinearRampExactlyInAnyPlane) {
  base::Rng rng(11);
  const glm::ivec3 size{70, 60, 50};
  const glm::ivec3 slopes[] = {{7, -11, 13}, {0, 0, 17}, {-5, 3, 1}};
  std::size_t compared = 0;
  for (int trial = 0; trial < 24; ++trial) {
    const glm::ivec3 slope_hu = slopes[trial % 3];
    glm::dmat3 direction = random_rotation(rng);
    if (trial % 2 == 1) direction = left_handed(direction);
    volume::Volume volume = noise_volume(size, {0.7, 0.9, 2.5}, direction, {-31.0, 12.0, 400.0}, 1);
    for (int k = 0; k < size.z; ++k)
      for (int j = 0; j < size.y; ++j)
        for (int i = 0; i < size.x; ++i)
          volume.hu[volume.index(i, j, k)] =
              static_cast<std::int16_t>(100 + slope_hu.x * i + slope_hu.y * j + slope_hu.z * k);
    const MprView view = random_view(rng, {-31.0, 12.0, 400.0}, 20.0, 0.6, 97, 64, Interpolation::linear);
    const HuImage image = GetParam().render(volume, view, {});
    for (int row = 0; row < view.height_px; ++row)
      for (int column = 0; column < view.width_px; ++column) {
        // The index along each axis from its direction cosine, without a matrix inverse.
        const glm::dvec3 from_first = pixel_lps_mm(view, column, row) - glm::dvec3(volume.lps_from_voxel[3]);
        bool within = true;
        double expected_hu = 100.0;
        for (int axis = 0; axis < 3; ++axis) {
          const double index = glm::dot(from_first, direction[axis]) / volume.spacing_mm[axis];
          within = within && index >= 0.0 && index <= size[axis] - 1.0;
          expected_hu += slope_hu[axis] * index;
        }
        if (!within) continue;
        ++compared;
        const float shown = image[static_cast<std::size_t>(row * view.width_px + column)];
        ASSERT_NEAR(shown, expected_hu, 0.01) << "trial " << trial << " pixel " << column << ", " << row;
      }
  }
  EXPECT_GT(compared, 50000U);
}

TEST_P(MprVolume, NearestPicksTheVoxelThatHoldsThePixel) {
  base::Rng rng(12);
  const glm::ivec3 size{11, 9, 7};
  std::size_t inside = 0, outside = 0;
  for (int trial = 0; trial < 12; ++trial) {
    glm::dmat3 direction = random_rotation(rng);
    if (trial % 2 == 1) direction = left_handed(direction);
    volume::Volume volume = noise_volume(size, {0.8, 1.1, 3.0}, direction, {50.0, -20.0, -7.0}, 2);
    for (std::size_t i = 0; i < volume.hu.size(); ++i) volume.hu[i] = static_cast<std::int16_t>(i);
    const MprView view = random_view(rng, {50.0, -20.0, -7.0}, 3.0, 0.4, 41, 37, Interpolation::nearest);
    const HuImage image = GetParam().render(volume, view, {});
    for (int row = 0; row < view.height_px; ++row)
      for (int column = 0; column < view.width_px; ++column) {
        const glm::dvec3 p_mm = pixel_lps_mm(view, column, row);
        float expected = volume::kAirHu;
        for (int k = 0; k < size.z; ++k)
          for (int j = 0; j < size.y; ++j)
            for (int i = 0; i < size.x; ++i) {
              const glm::dvec3 off_mm = p_mm - glm::dvec3(volume.lps_from_voxel * glm::dvec4(i, j, k, 1.0));
              bool holds = true;
              for (int axis = 0; axis < 3; ++axis)
                holds = holds && std::abs(glm::dot(off_mm, direction[axis])) <= 0.5 * volume.spacing_mm[axis];
              if (holds) expected = volume.at(i, j, k);
            }
        ++(expected == volume::kAirHu ? outside : inside);
        ASSERT_EQ(image[static_cast<std::size_t>(row * view.width_px + column)], expected)
            << "trial " << trial << " pixel " << column << ", " << row;
      }
  }
  EXPECT_GT(inside, 2000U);
  EXPECT_GT(outside, 2000U);
}

TEST_P(MprVolume, IsPaddingOutsideAndRepeatsTheOutermostVoxelsInTheLastHalf) {
  volume::Volume volume = volume::make_volume({3, 3, 3}, glm::dvec3(1.0), glm::dmat3(1.0), glm::dvec3(0.0));
  for (int k = 0; k < 3; ++k)
    for (int j = 0; j < 3; ++j)
      for (int i = 0; i < 3; ++i) volume.hu[volume.index(i, j, k)] = static_cast<std::int16_t>(100 * i);
  MprView view;  // columns at i = −1, −0.75, …, 3
  view.center_lps_mm = {1.0, 1.0, 1.0};
  view.pixel_mm = 0.25;
  view.width_px = 17;
  view.height_px = 1;
  const float out = -1024.0F;
  EXPECT_EQ(GetParam().render(volume, view, {}),
            (HuImage{out, out, 0, 0, 0, 25, 50, 75, 100, 125, 150, 175, 200, 200, 200, out, out}));
  view.interpolation = Interpolation::nearest;
  EXPECT_EQ(GetParam().render(volume, view, {}),
            (HuImage{out, out, 0, 0, 0, 0, 100, 100, 100, 100, 200, 200, 200, 200, 200, out, out}));
}

TEST_P(MprVolume, AVolumeOfOneSliceShowsThatSlice) {
  volume::Volume volume = volume::make_volume({4, 1, 1}, {1.0, 1.0, 5.0}, glm::dmat3(1.0), glm::dvec3(0.0));
  volume.hu = {10, 20, 30, 40};
  MprView view;
  view.width_px = 4;
  view.height_px = 1;
  view.pixel_mm = 1.0;
  for (const double z_mm : {-2.4, 0.0, 2.4}) {
    view.center_lps_mm = {1.5, 0.3, z_mm};
    EXPECT_EQ(GetParam().render(volume, view, {}), (HuImage{10, 20, 30, 40})) << z_mm;
  }
  view.center_lps_mm.z = 2.6;
  EXPECT_EQ(GetParam().render(volume, view, {}), HuImage(4, -1024.0F));
}

TEST_P(MprVolume, APlaneThatIsNowhereIsPadding) {
  const volume::Volume volume = noise_volume({8, 8, 8}, glm::dvec3(1.0), glm::dmat3(1.0), glm::dvec3(0.0), 3);
  MprView view;
  view.width_px = 9;
  view.height_px = 7;
  for (const Interpolation interpolation : {Interpolation::nearest, Interpolation::linear})
    for (const double at_mm :
         {1e4, -1e30, std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()}) {
      view.interpolation = interpolation;
      view.center_lps_mm = {0.0, at_mm, 0.0};
      Inserted inserted;
      inserted.needle = NeedlePose{};
      inserted.lesions = {{{0.0, 0.0, 0.0}, 3.0, 50.0}};
      EXPECT_EQ(GetParam().render(volume, view, inserted), HuImage(63, -1024.0F)) << at_mm;
    }
}

INSTANTIATE_TEST_SUITE_P(Backends, MprVolume, testing::ValuesIn(kBackends),
                         [](const auto& backend) { return backend.param.name; });

// Both round to float last. Where their doubles (equal to some 1e-9 HU) lie on two sides of a float's rounding
// limit, the floats are neighbours; that is rare.
TEST(MprCpu, IsTheReference) {
  constexpr double kNeighbourHu = 0.000245;  // spacing of floats between 2048 and 4096
  base::Rng rng(13);
  for (int trial = 0; trial < 16; ++trial) {
    glm::dmat3 direction = random_rotation(rng);
    if (trial % 4 == 1) direction = left_handed(direction);
    const volume::Volume volume = noise_volume({61, 83, 40}, {0.7, 0.6, 1.5}, direction, {5.0, 90.0, -300.0}, 4);
    MprView view = random_view(rng, {5.0, 90.0, -300.0}, 15.0, 0.31, 203, 301,
                               trial % 3 == 0 ? Interpolation::nearest : Interpolation::linear);
    view.needle_slab_mm = trial % 2 == 0 ? 0.0 : 3.0;
    Inserted inserted;
    inserted.needle = NeedlePose{.tip_lps_mm = view.center_lps_mm + 2.0 * random_direction(rng),
                                 .direction = glm::normalize(view.u + 0.1 * random_direction(rng)),
                                 .length_mm = 60.0,
                                 .radius_mm = 0.9,
                                 .inner_radius_mm = trial % 4 == 0 ? 0.6 : 0.0};
    for (int i = 0; i < 5; ++i)
      inserted.lesions.push_back({view.center_lps_mm + 12.0 * random_direction(rng), 3.0 + 2.0 * i, 20.0 * i});
    const HuImage cpu = mpr_cpu(volume, view, inserted), reference = mpr_reference(volume, view, inserted);
    EXPECT_TRUE(images_agree(cpu, reference, view.width_px, kNeighbourHu, {}, "cpu_is_reference"));
    std::size_t same = 0;
    for (std::size_t i = 0; i < cpu.size(); ++i) same += cpu[i] == reference[i] ? 1 : 0;
    EXPECT_GE(same + 20, cpu.size());
  }
}

}  // namespace
}  // namespace seldinger::imaging
