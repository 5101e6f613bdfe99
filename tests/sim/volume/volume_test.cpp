// Tests of the volume's geometry and of the reference samplers: affine fields, corners, faces, NaN.
#include "sim/volume/volume.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <limits>

#include "sim/base/rng.h"

namespace seldinger::volume {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

glm::dmat3 oblique(bool left_handed) {
  glm::dmat3 direction(glm::rotate(glm::dmat4(1.0), 0.6, glm::normalize(glm::dvec3(0.3, -1.0, 0.8))));
  if (left_handed) direction[2] = -direction[2];
  return direction;
}

// HU = 3 i − 5 j + 7 k: trilinear interpolation must reproduce it exactly.
Volume affine_field() {
  Volume volume = make_volume({6, 5, 4}, {0.5, 0.75, 2.0}, oblique(false), {10.0, -20.0, 30.0});
  for (int k = 0; k < 4; ++k)
    for (int j = 0; j < 5; ++j)
      for (int i = 0; i < 6; ++i)
        volume.hu[volume.index(i, j, k)] = static_cast<std::int16_t>(3 * i - 5 * j + 7 * k);
  return volume;
}

TEST(Volume, a_new_volume_is_air_and_places_its_first_voxel_at_the_origin) {
  const Volume volume = make_volume({2, 3, 4}, {0.5, 0.75, 2.0}, glm::dmat3(1.0), {1.0, 2.0, 3.0});
  EXPECT_EQ(volume.hu.size(), 24U);
  for (const std::int16_t hu : volume.hu) EXPECT_EQ(hu, kAirHu);
  EXPECT_EQ(volume.lps_from_voxel * glm::dvec4(0.0, 0.0, 0.0, 1.0), glm::dvec4(1.0, 2.0, 3.0, 1.0));
  EXPECT_EQ(volume.lps_from_voxel * glm::dvec4(1.0, 2.0, 3.0, 1.0), glm::dvec4(1.5, 3.5, 9.0, 1.0));
}

TEST(Volume, i_runs_fastest) {
  const Volume volume = affine_field();
  EXPECT_EQ(volume.index(1, 0, 0), 1U);
  EXPECT_EQ(volume.index(0, 1, 0), 6U);
  EXPECT_EQ(volume.index(0, 0, 1), 30U);
  EXPECT_EQ(volume.at(4, 3, 2), 12 - 15 + 14);
}

TEST(Volume, the_way_to_voxels_and_back_is_the_identity_for_either_handedness) {
  for (const bool left_handed : {false, true}) {
    const Volume volume = make_volume({6, 5, 4}, {0.5, 0.75, 2.0}, oblique(left_handed), {10.0, -20.0, 30.0});
    const glm::dmat4 voxel_from = voxel_from_lps(volume);
    for (int column = 0; column < 4; ++column) EXPECT_EQ(voxel_from[column][3], column == 3 ? 1.0 : 0.0);
    base::Rng rng(1);
    for (int n = 0; n < 200; ++n) {
      const glm::dvec4 p(200.0 * rng.uniform() - 100.0, 200.0 * rng.uniform() - 100.0, 200.0 * rng.uniform(), 1.0);
      EXPECT_TRUE(glm::length(volume.lps_from_voxel * (voxel_from * p) - p) < 1e-10);
    }
  }
}

TEST(Volume, the_inside_ends_half_a_voxel_beyond_the_centres) {
  const Volume volume = affine_field();
  EXPECT_TRUE(inside(volume, {-0.5, -0.5, -0.5}));
  EXPECT_TRUE(inside(volume, {5.5, 4.5, 3.5}));
  const double more = 1e-9;
  for (int axis = 0; axis < 3; ++axis) {
    glm::dvec3 low(0.0), high(0.0);
    low[axis] = -0.5 - more;
    high[axis] = volume.size_voxels[axis] - 0.5 + more;
    for (const glm::dvec3& index : {low, high}) {
      EXPECT_FALSE(inside(volume, index));
      EXPECT_FALSE(sample_nearest(volume, index).has_value());
      EXPECT_FALSE(sample_trilinear(volume, index).has_value());
    }
  }
}

TEST(Volume, nan_and_infinity_are_outside) {
  const Volume volume = affine_field();
  for (const double value :
       {kNan, std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()})
    for (int axis = 0; axis < 3; ++axis) {
      glm::dvec3 index(1.0);
      index[axis] = value;
      EXPECT_FALSE(inside(volume, index));
      EXPECT_FALSE(sample_nearest(volume, index).has_value());
      EXPECT_FALSE(sample_trilinear(volume, index).has_value());
    }
}

TEST(Volume, nearest_is_the_voxel_whose_centre_is_closest) {
  const Volume volume = affine_field();
  base::Rng rng(2);
  for (int n = 0; n < 500; ++n) {
    const glm::dvec3 index(-0.5 + 6.0 * rng.uniform(), -0.5 + 5.0 * rng.uniform(), -0.5 + 4.0 * rng.uniform());
    double best = std::numeric_limits<double>::infinity();
    std::int16_t expected = 0;
    for (int k = 0; k < 4; ++k)
      for (int j = 0; j < 5; ++j)
        for (int i = 0; i < 6; ++i) {
          const double distance = glm::length(glm::dvec3(i, j, k) - index);
          if (distance < best) {
            best = distance;
            expected = volume.at(i, j, k);
          }
        }
    EXPECT_EQ(sample_nearest(volume, index), expected);
  }
}

TEST(Volume, the_faces_belong_to_the_outermost_voxels) {
  const Volume volume = affine_field();
  EXPECT_EQ(sample_nearest(volume, {-0.5, -0.5, -0.5}), volume.at(0, 0, 0));
  EXPECT_EQ(sample_nearest(volume, {5.5, 4.5, 3.5}), volume.at(5, 4, 3));
  EXPECT_EQ(sample_trilinear(volume, {-0.5, -0.5, -0.5}), static_cast<double>(volume.at(0, 0, 0)));
  EXPECT_EQ(sample_trilinear(volume, {5.5, 4.5, 3.5}), static_cast<double>(volume.at(5, 4, 3)));
}

TEST(Volume, trilinear_reproduces_an_affine_field_and_clamps_in_the_last_half_voxel) {
  const Volume volume = affine_field();
  base::Rng rng(3);
  for (int n = 0; n < 500; ++n) {
    const glm::dvec3 index(-0.5 + 6.0 * rng.uniform(), -0.5 + 5.0 * rng.uniform(), -0.5 + 4.0 * rng.uniform());
    const glm::dvec3 at = glm::clamp(index, glm::dvec3(0.0), glm::dvec3(5.0, 4.0, 3.0));
    const auto sample = sample_trilinear(volume, index);
    ASSERT_TRUE(sample.has_value());
    EXPECT_NEAR(*sample, 3.0 * at.x - 5.0 * at.y + 7.0 * at.z, 1e-12);
  }
}

TEST(Volume, trilinear_weighs_the_eight_corners) {
  Volume volume = make_volume({2, 2, 2}, glm::dvec3(1.0), glm::dmat3(1.0), glm::dvec3(0.0));
  for (std::size_t corner = 0; corner < 8; ++corner) {
    std::fill(volume.hu.begin(), volume.hu.end(), std::int16_t{0});
    volume.hu[corner] = 1000;
    const double x = (corner & 1U) != 0 ? 0.2 : 0.8, y = (corner & 2U) != 0 ? 0.3 : 0.7;
    const double z = (corner & 4U) != 0 ? 0.9 : 0.1;
    EXPECT_NEAR(sample_trilinear(volume, {0.2, 0.3, 0.9}).value(), 1000.0 * x * y * z, 1e-10);
  }
}

TEST(Volume, a_single_slice_can_be_sampled) {
  Volume volume = make_volume({2, 2, 1}, glm::dvec3(1.0), glm::dmat3(1.0), glm::dvec3(0.0));
  volume.hu = {0, 10, 20, 30};
  EXPECT_EQ(sample_trilinear(volume, {0.5, 0.5, 0.4}), 15.0);
  EXPECT_EQ(sample_nearest(volume, {1.2, 0.9, -0.5}), std::int16_t{30});
}

TEST(VolumeDeathTest, a_volume_without_size_or_spacing_is_a_mistake) {
  EXPECT_DEATH(make_volume({0, 1, 1}, glm::dvec3(1.0), glm::dmat3(1.0), glm::dvec3(0.0)), "CHECK");
  EXPECT_DEATH(make_volume({1, 1, 1}, {1.0, kNan, 1.0}, glm::dmat3(1.0), glm::dvec3(0.0)), "CHECK");
}

}  // namespace
}  // namespace seldinger::volume
