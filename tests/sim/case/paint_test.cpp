// Painting: what a volume holds afterwards, against closed forms of volume and line integral.
#include "sim/case/paint.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace seldinger::cases {
namespace {

// Oblique, with thick slices.
volume::Volume grid() {
  const double c = std::cos(0.3), s = std::sin(0.3);
  volume::Volume made =
      volume::make_volume({60, 50, 24}, {0.9, 0.8, 3.0}, glm::dmat3(c, s, 0, -s, c, 0, 0, 0, 1), {-20, -30, -30});
  std::fill(made.hu.begin(), made.hu.end(), std::int16_t{40});
  return made;
}

double added_mm3(const volume::Volume& volume, double from_hu, double to_hu) {
  double sum = 0.0;
  for (const std::int16_t hu : volume.hu) sum += (hu - from_hu) / (to_hu - from_hu);
  return sum * volume.spacing_mm.x * volume.spacing_mm.y * volume.spacing_mm.z;
}

glm::dvec3 middle(const volume::Volume& volume) {
  return glm::dvec3(volume.lps_from_voxel * glm::dvec4(glm::dvec3(volume.size_voxels - 1) / 2.0, 1.0));
}

TEST(PaintTest, AShapesVolumeArrives) {
  constexpr double kPi = std::numbers::pi;
  const glm::dvec3 at = middle(grid());
  const std::pair<Shape, double> shapes[] = {
      {Sphere{at, 9.0}, 4.0 / 3.0 * kPi * 729.0},
      {Ellipsoid{at + glm::dvec3(0.3, 0.1, 1.0), {12, 5, 7}}, 4.0 / 3.0 * kPi * 420.0},
      {Tube{{at - glm::dvec3(0, 0, 12), at + glm::dvec3(0, 0, 12)}, 3.0},
       kPi * 9.0 * 24.0 + 4.0 / 3.0 * kPi * 27.0}};
  for (const auto& [shape, mm3] : shapes) {
    for (const double edge_mm : {0.0, 1.0}) {
      volume::Volume volume = grid();
      paint(shape, {540.0, false, edge_mm}, volume);
      // A ramp is even in the distance: to first order what it takes inside it gives outside.
      EXPECT_NEAR(added_mm3(volume, 40.0, 540.0) / mm3, 1.0, edge_mm == 0.0 ? 0.01 : 0.02);
    }
  }
}

TEST(PaintTest, WhatIsAddedLeavesTheTissueBelow) {
  volume::Volume volume = grid();
  for (std::size_t i = 0; i < volume.hu.size(); ++i) volume.hu[i] = static_cast<std::int16_t>(40 + i % 7);
  const volume::Volume before = volume;
  const Painted painted = paint(Sphere{middle(volume), 8.0}, {25.0, true, 0.0}, volume);
  EXPECT_GT(painted.voxels, 500U);
  EXPECT_NEAR(painted.hu - painted.before_hu, 25.0, 5.0);  // voxels across the surface get a share
  EXPECT_NEAR(painted.before_hu, 43.0, 0.2);
  const glm::ivec3 at(glm::dvec3(volume.size_voxels - 1) / 2.0);
  EXPECT_EQ(volume.at(at.x, at.y, at.z), before.at(at.x, at.y, at.z) + 25);
  EXPECT_EQ(volume.at(0, 0, 0), before.at(0, 0, 0));
}

TEST(PaintTest, ASoftEdgeIsARamp) {
  volume::Volume volume = volume::make_volume({81, 9, 9}, {0.25, 1, 1}, glm::dmat3(1.0), {0, -4, -4});
  std::fill(volume.hu.begin(), volume.hu.end(), std::int16_t{0});
  paint(Sphere{{-90, 0, 0}, 100.0}, {1000.0, false, 8.0}, volume);  // nearly flat, at x = 10
  for (int i = 0; i <= 80; ++i) {
    const double x_mm = 0.25 * i;
    EXPECT_NEAR(volume.at(i, 4, 4), 1000.0 * std::clamp(0.5 - (x_mm - 10.0) / 8.0, 0.0, 1.0), 20.0) << x_mm;
  }
}

TEST(PaintTest, AVoxelIsOfAClassByItsCentre) {
  const volume::Volume volume = grid();
  std::vector<volume::TissueClass> classes(volume.hu.size(), volume::TissueClass::soft_tissue);
  const Shape tube = Tube{{middle(volume), middle(volume) + glm::dvec3(9, 4, 7)}, 4.0};
  paint_class(tube, volume::TissueClass::vessel, volume, classes);
  std::size_t at = 0, vessels = 0;
  for (int k = 0; k < volume.size_voxels.z; ++k)
    for (int j = 0; j < volume.size_voxels.y; ++j)
      for (int i = 0; i < volume.size_voxels.x; ++i, ++at) {
        const glm::dvec3 p(volume.lps_from_voxel * glm::dvec4(i, j, k, 1.0));
        const bool inside = signed_distance_mm(tube, p, 5.0) <= 0.0;
        ASSERT_EQ(classes[at] == volume::TissueClass::vessel, inside);
        vessels += inside ? 1 : 0;
      }
  EXPECT_GT(vessels, 100U);
}

TEST(PaintTest, BesideTheVolumeNothingHappens) {
  volume::Volume volume = grid();
  EXPECT_EQ(paint(Sphere{{500, 0, 0}, 20.0}, {100.0, false, 0.0}, volume).voxels, 0U);
  EXPECT_EQ(volume.hu, grid().hu);
  EXPECT_EQ(paint(VoxelSet{}, {100.0, false, 2.0}, volume).voxels, 0U);
  EXPECT_EQ(volume.hu, grid().hu);
}

}  // namespace
}  // namespace seldinger::cases
