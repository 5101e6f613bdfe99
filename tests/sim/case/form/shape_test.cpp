// Shapes: closed forms, and the two questions (how far, which part is inside) against each other on random ways.
#include "sim/case/form/shape.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>

#include "sim/base/rng.h"

namespace seldinger::cases {
namespace {

constexpr double kFar = 1e3;

glm::dvec3 random_point(base::Rng& rng, double reach_mm) {
  const auto one = [&] { return reach_mm * (2.0 * rng.uniform() - 1.0); };
  const double x = one(), y = one();
  return {x, y, one()};
}

double length_of(const std::vector<Stretch>& stretches) {
  double sum = 0.0;
  for (const Stretch& stretch : stretches) sum += stretch.to - stretch.from;
  return sum;
}

TEST(ShapeTest, SphereHasItsChord) {
  const Shape sphere = Sphere{{10, 20, 30}, 5.0};
  EXPECT_NEAR(signed_distance_mm(sphere, {10, 20, 42}, kFar), 7.0, 1e-12);
  EXPECT_NEAR(signed_distance_mm(sphere, {10, 20, 31}, kFar), -4.0, 1e-12);
  EXPECT_EQ(signed_distance_mm(sphere, {10, 20, 42}, 2.0), 2.0);
  const auto chord = stretches_inside(sphere, {0, 23, 30}, {20, 23, 30});  // 3 mm beside the centre: 8 mm long
  ASSERT_EQ(chord.size(), 1u);
  EXPECT_NEAR((chord[0].to - chord[0].from) * 20.0, 8.0, 1e-12);
  EXPECT_TRUE(stretches_inside(sphere, {0, 26, 30}, {20, 26, 30}).empty());
}

TEST(ShapeTest, EllipsoidOnItsAxes) {
  const Shape shape = Ellipsoid{{1, 2, 3}, {4, 6, 9}};
  EXPECT_NEAR(signed_distance_mm(shape, {1 + 7, 2, 3}, kFar), 3.0, 1e-9);
  EXPECT_NEAR(signed_distance_mm(shape, {1, 2 - 8, 3}, kFar), 2.0, 1e-9);
  EXPECT_NEAR(signed_distance_mm(shape, {1, 2, 3 + 10}, kFar), 1.0, 1e-9);
  EXPECT_NEAR(signed_distance_mm(shape, {1, 2, 3}, kFar), -4.0, 1e-9);        // the centre: the shortest radius
  EXPECT_NEAR(signed_distance_mm(shape, {1, 2, 3 + 8.9}, kFar), -0.1, 1e-9);  // near a pole, within its curvature
  const Shape ball = Ellipsoid{{0, 0, 0}, {5, 5, 5}};
  EXPECT_NEAR(signed_distance_mm(ball, {0, 0, 0}, kFar), -5.0, 1e-9);
  EXPECT_NEAR(signed_distance_mm(ball, {1, 2, 2}, kFar), -2.0, 1e-9);
}

TEST(ShapeTest, EllipsoidIsAsFarAsItsNearestPoint) {
  const glm::dvec3 radii(4, 6, 9);
  const Shape shape = Ellipsoid{{0, 0, 0}, radii};
  base::Rng rng(7);
  for (int i = 0; i < 200; ++i) {
    const glm::dvec3 point = random_point(rng, 12.0);
    double nearest = kFar;
    constexpr int kSteps = 200;
    for (int u = 0; u <= kSteps; ++u)
      for (int v = 0; v < 2 * kSteps; ++v) {
        const double theta = M_PI * u / kSteps, phi = M_PI * v / kSteps;
        const glm::dvec3 on =
            radii * glm::dvec3(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta));
        nearest = std::min(nearest, glm::distance(on, point));
      }
    const double told = signed_distance_mm(shape, point, kFar);
    EXPECT_LE(std::abs(told), nearest + 1e-9);
    EXPECT_NEAR(std::abs(told), nearest, 0.1);
    const glm::dvec3 share = point / radii;
    EXPECT_EQ(told < 0.0, glm::dot(share, share) < 1.0);
  }
}

TEST(ShapeTest, TubeIsCrossedInPieces) {
  const Shape tube = Tube{{{0, 0, 0}, {0, 0, 50}, {0, 40, 50}}, 3.0};
  EXPECT_NEAR(signed_distance_mm(tube, {10, 0, 20}, kFar), 7.0, 1e-12);
  EXPECT_NEAR(signed_distance_mm(tube, {0, 0, -10}, kFar), 7.0, 1e-12);  // its end is round
  const auto twice = stretches_inside(tube, {0, 20, -20}, {0, 20, 80});  // the second piece only
  ASSERT_EQ(twice.size(), 1u);
  EXPECT_NEAR(length_of(twice) * 100.0, 6.0, 1e-9);
  const auto both = stretches_inside(tube, {0, -20, 20}, {0, 40, 80});  // 45 degrees through both limbs
  ASSERT_EQ(both.size(), 2u);                                           // 6 mm in y each, of 60
  EXPECT_NEAR(length_of(both), 0.2, 1e-12);
  const auto along = stretches_inside(tube, {0, 0, 10}, {0, 0, 30});
  ASSERT_EQ(along.size(), 1u);
  EXPECT_NEAR(length_of(along), 1.0, 1e-12);
}

volume::Volume oblique_grid() {
  const double c = std::cos(0.4), s = std::sin(0.4);
  return volume::make_volume({20, 16, 8}, {0.8, 0.9, 5.0}, glm::dmat3(c, s, 0, -s, c, 0, 0, 0, 1), {-7, 3, 40});
}

TEST(ShapeTest, VoxelsAreTheBoxesTheyFill) {
  const volume::Volume grid = oblique_grid();
  std::vector<std::uint8_t> labels(grid.hu.size(), 0);
  for (int k = 2; k <= 4; ++k)
    for (int j = 5; j <= 9; ++j)
      for (int i = 3; i <= 12; ++i) labels[grid.index(i, j, k)] = 9;
  const VoxelSet set = voxels_with(grid, labels, 9);
  EXPECT_EQ(set.low, glm::ivec3(3, 5, 2));
  EXPECT_EQ(set.size, glm::ivec3(10, 5, 3));
  const auto lps = [&](double i, double j, double k) {
    return glm::dvec3(grid.lps_from_voxel * glm::dvec4(i, j, k, 1));
  };
  const Shape shape = set;
  EXPECT_NEAR(signed_distance_mm(shape, lps(2, 7, 3), 50.0), 0.5 * 0.8, 1e-9);
  EXPECT_NEAR(signed_distance_mm(shape, lps(7, 7, 3), 50.0), -2.5 * 0.9, 1e-9);
  EXPECT_NEAR(signed_distance_mm(shape, lps(7, 7, 6), 50.0), 7.5, 1e-9);
  EXPECT_EQ(signed_distance_mm(shape, lps(500, 7, 6), 20.0), 20.0);
  const auto through = stretches_inside(shape, lps(0, 7, 3), lps(19, 7, 3));
  ASSERT_EQ(through.size(), 1u);
  EXPECT_NEAR(length_of(through) * 19.0, 10.0, 1e-9);
  EXPECT_TRUE(voxels_with(grid, labels, 4).member.empty());
  EXPECT_EQ(signed_distance_mm(voxels_with(grid, labels, 4), lps(1, 1, 1), 20.0), 20.0);
}

// What lies inside by stretches lies inside by distance, on random ways through random shapes.
TEST(ShapeTest, StretchesAndDistancesAgree) {
  base::Rng rng(11);
  const volume::Volume grid = oblique_grid();
  std::vector<std::uint8_t> labels(grid.hu.size());
  for (std::uint8_t& label : labels) label = rng.uniform() < 0.4 ? 1 : 0;
  const Shape shapes[] = {Sphere{{1, 2, 3}, 6.0}, Ellipsoid{{0, 5, 50}, {9, 4, 14}},
                          Tube{{{-20, 0, 40}, {10, 5, 50}, {10, -15, 70}, {30, 30, 30}}, 4.0},
                          voxels_with(grid, labels, 1)};
  for (const Shape& shape : shapes) {
    const Bounds box = bounds_of(shape);
    const glm::dvec3 middle = 0.5 * (box.low_lps_mm + box.high_lps_mm);
    int inside_points = 0;
    for (int way = 0; way < 300; ++way) {
      const glm::dvec3 a = middle + random_point(rng, 25.0), b = middle + random_point(rng, 25.0);
      const auto stretches = stretches_inside(shape, a, b);
      for (int i = 0; i < 20; ++i) {
        const double at = rng.uniform();
        bool in = false, edge = false;
        for (const Stretch& stretch : stretches) {
          in = in || (at > stretch.from && at < stretch.to);
          edge = edge || std::abs(at - stretch.from) < 1e-9 || std::abs(at - stretch.to) < 1e-9;
        }
        const double distance = signed_distance_mm(shape, a + at * (b - a), 100.0);
        if (edge || std::abs(distance) < 1e-6) continue;
        EXPECT_EQ(in, distance < 0.0) << distance;
        if (in) {
          ++inside_points;
          const glm::dvec3 point = a + at * (b - a);
          EXPECT_TRUE(glm::all(glm::greaterThanEqual(point, box.low_lps_mm - 1e-9)) &&
                      glm::all(glm::lessThanEqual(point, box.high_lps_mm + 1e-9)));
        }
      }
    }
    EXPECT_GT(inside_points, 50);
  }
}

}  // namespace
}  // namespace seldinger::cases
