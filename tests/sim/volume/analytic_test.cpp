// Tests of analytic shapes: membership against closed forms, rasterisation against membership, known volumes.
#include "sim/volume/analytic.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "sim/base/rng.h"

namespace seldinger::volume {
namespace {

constexpr double kPi = 3.14159265358979323846;

std::vector<Shape> random_shapes(int count, std::uint64_t seed) {
  base::Rng rng(seed);
  const auto point = [&] { return glm::dvec3(30.0 * rng.uniform(), 30.0 * rng.uniform(), 30.0 * rng.uniform()); };
  std::vector<Shape> shapes;
  for (int n = 0; n < count; ++n) {
    Geometry geometry;
    if (n % 4 == 0) {
      const glm::dvec3 a = point(), b = point();
      geometry = Box{glm::min(a, b), glm::max(a, b)};
    } else if (n % 4 == 1) {
      geometry = Sphere{point(), 8.0 * rng.uniform()};
    } else if (n % 4 == 2) {
      geometry = Cylinder{point(), point(), 5.0 * rng.uniform()};
    } else {
      geometry = Ellipsoid{point(), 0.3 * point() + 0.1};
    }
    shapes.push_back({geometry, std::floor(1000.0 * rng.uniform()), "tissue" + std::to_string(n % 7)});
  }
  return shapes;
}

AnalyticVolume scene_of(std::vector<Shape> shapes, glm::dvec3 spacing_mm) {
  AnalyticVolume analytic;
  analytic.spacing_mm = spacing_mm;
  analytic.origin_mm = {-1.3, 2.1, -0.7};
  for (int axis = 0; axis < 3; ++axis) analytic.size_voxels[axis] = static_cast<int>(30.0 / spacing_mm[axis]) + 2;
  analytic.shapes = std::move(shapes);
  return analytic;
}

// What the comments of analytic.h say, voxel by voxel, without bounds or rows.
void expect_as_painted_point_by_point(const AnalyticVolume& analytic) {
  LabelMap labels;
  const Volume volume = rasterize(analytic, labels);
  std::size_t wrong = 0, at = 0;
  for (int k = 0; k < analytic.size_voxels.z; ++k)
    for (int j = 0; j < analytic.size_voxels.y; ++j)
      for (int i = 0; i < analytic.size_voxels.x; ++i, ++at) {
        const glm::dvec3 p = analytic.origin_mm + glm::dvec3(i, j, k) * analytic.spacing_mm;
        double hu = analytic.background_hu;
        std::string name = "none";
        for (const Shape& shape : analytic.shapes) {
          if (!contains(shape.geometry, p)) continue;
          if (!shape.over.empty() && std::find(shape.over.begin(), shape.over.end(), name) == shape.over.end())
            continue;
          hu = shape.hu;
          name = shape.class_name.empty() ? "none" : shape.class_name;
        }
        if (volume.hu[at] != static_cast<std::int16_t>(hu) || labels.names[labels.label[at]] != name) ++wrong;
      }
  EXPECT_EQ(wrong, 0U);
}

TEST(Analytic, membership_is_that_of_the_formula_inside_on_and_outside) {
  const Box box{{0.0, 0.0, 0.0}, {1.0, 2.0, 3.0}};
  EXPECT_TRUE(contains(box, {1.0, 2.0, 3.0}));
  EXPECT_FALSE(contains(box, {1.0, 2.0, std::nextafter(3.0, 4.0)}));
  const Sphere sphere{{1.0, 1.0, 1.0}, 5.0};
  EXPECT_TRUE(contains(sphere, {4.0, 5.0, 1.0}));
  EXPECT_FALSE(contains(sphere, {4.0, 5.0, 1.001}));
  const Ellipsoid ellipsoid{{0.0, 0.0, 0.0}, {1.0, 2.0, 4.0}};
  EXPECT_TRUE(contains(ellipsoid, {0.0, 0.0, -4.0}));
  EXPECT_FALSE(contains(ellipsoid, {0.9, 1.0, 0.0}));
  const Cylinder cylinder{{0.0, 0.0, 0.0}, {0.0, 0.0, 10.0}, 2.0};
  EXPECT_TRUE(contains(cylinder, {2.0, 0.0, 10.0}));
  EXPECT_TRUE(contains(cylinder, {0.0, -2.0, 0.0}));
  EXPECT_FALSE(contains(cylinder, {0.0, 0.0, 10.001}));
  EXPECT_FALSE(contains(cylinder, {2.001, 0.0, 5.0}));
}

TEST(Analytic, nothing_contains_nan) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const Shape& shape : random_shapes(8, 1)) EXPECT_FALSE(contains(shape.geometry, {1.0, nan, 1.0}));
}

TEST(Analytic, a_cylinder_without_length_contains_nothing) {
  EXPECT_FALSE(contains(Cylinder{{1.0, 2.0, 3.0}, {1.0, 2.0, 3.0}, 5.0}, {1.0, 2.0, 3.0}));
  EXPECT_FALSE(contains(Cylinder{{1.0, 2.0, 3.0}, {1.0, 2.0, 3.0}, 5.0}, {80.0, 2.0, 3.0}));
}

TEST(Analytic, an_oblique_cylinder_contains_what_lies_close_to_its_axis) {
  const Cylinder cylinder{{-3.0, 2.0, 1.0}, {9.0, -6.0, 7.0}, 2.5};
  base::Rng rng(5);
  int inside_count = 0;
  for (int n = 0; n < 5000; ++n) {
    const glm::dvec3 p(-6.0 + 18.0 * rng.uniform(), -9.0 + 14.0 * rng.uniform(), -2.0 + 12.0 * rng.uniform());
    const glm::dvec3 axis = glm::normalize(cylinder.to_mm - cylinder.from_mm);
    const double along = glm::dot(p - cylinder.from_mm, axis);
    const double across = glm::length(p - cylinder.from_mm - along * axis);
    const bool expected = along >= 0.0 && along <= glm::distance(cylinder.from_mm, cylinder.to_mm) && across <= 2.5;
    EXPECT_EQ(contains(cylinder, p), expected);
    inside_count += expected ? 1 : 0;
  }
  EXPECT_GT(inside_count, 300);
}

TEST(Analytic, every_voxel_is_that_of_the_last_shape_that_contains_it) {
  expect_as_painted_point_by_point(scene_of(random_shapes(60, 2), {1.0, 1.0, 1.0}));
  expect_as_painted_point_by_point(scene_of(random_shapes(60, 3), {0.7, 1.1, 2.3}));
}

TEST(Analytic, a_shape_with_over_paints_only_those_classes) {
  std::vector<Shape> shapes = random_shapes(60, 4);
  for (std::size_t n = 5; n < shapes.size(); n += 3) shapes[n].over = {"tissue1", "tissue4"};
  shapes[50].over = {"none"};
  shapes[53].over = {"never_painted"};
  shapes[20].class_name.clear();
  expect_as_painted_point_by_point(scene_of(std::move(shapes), {1.0, 0.9, 1.3}));
}

TEST(Analytic, shapes_whose_surface_lies_on_voxel_centres_include_them) {
  AnalyticVolume analytic;
  analytic.size_voxels = {21, 21, 21};
  analytic.origin_mm = glm::dvec3(-10.0);
  for (const Geometry& geometry : std::initializer_list<Geometry>{
           Box{glm::dvec3(-3.0), glm::dvec3(3.0)}, Sphere{glm::dvec3(0.0), 5.0},
           Ellipsoid{glm::dvec3(0.0), {8.0, 4.0, 2.0}}, Cylinder{{0.0, 0.0, -4.0}, {0.0, 0.0, 4.0}, 5.0},
           Cylinder{{-6.0, 0.0, 0.0}, {6.0, 0.0, 0.0}, 5.0}}) {
    analytic.shapes = {{geometry, 100.0, "tissue"}};
    expect_as_painted_point_by_point(analytic);
  }
  analytic.shapes = {{Sphere{glm::dvec3(0.0), 5.0}, 100.0}};
  const Volume volume = rasterize(analytic);
  EXPECT_EQ(volume.at(15, 10, 10), 100);
  EXPECT_EQ(volume.at(13, 14, 10), 100);
  EXPECT_EQ(volume.at(16, 10, 10), -1000);
}

TEST(Analytic, voxel_counts_approach_the_shapes_volumes) {
  const struct {
    Geometry geometry;
    double mm3;
  } cases[] = {{Sphere{{10.0, 11.0, 12.0}, 9.0}, 4.0 / 3.0 * kPi * 729.0},
               {Ellipsoid{{10.0, 11.0, 12.0}, {9.0, 6.0, 10.0}}, 4.0 / 3.0 * kPi * 540.0},
               {Cylinder{{5.0, 6.0, 7.0}, {18.0, 16.0, 19.0}, 5.0}, kPi * 25.0 * std::sqrt(169.0 + 100.0 + 144.0)},
               {Box{{2.0, 3.0, 4.0}, {18.0, 20.0, 22.0}}, 16.0 * 17.0 * 18.0}};
  for (const auto& known : cases) {
    AnalyticVolume analytic;
    analytic.size_voxels = {120, 120, 120};
    analytic.spacing_mm = glm::dvec3(0.21);
    analytic.shapes = {{known.geometry, 500.0}};
    const Volume volume = rasterize(analytic);
    const auto count = std::count(volume.hu.begin(), volume.hu.end(), std::int16_t{500});
    EXPECT_NEAR(static_cast<double>(count) * 0.21 * 0.21 * 0.21 / known.mm3, 1.0, 0.02);
  }
}

TEST(Analytic, hu_is_rounded_and_kept_in_range) {
  AnalyticVolume analytic;
  analytic.size_voxels = {1, 1, 1};
  const auto hu_of = [&](double hu) {
    analytic.shapes = {{Sphere{glm::dvec3(0.0), 1.0}, hu}};
    return rasterize(analytic).hu[0];
  };
  EXPECT_EQ(hu_of(40.4), 40);
  EXPECT_EQ(hu_of(40.6), 41);
  EXPECT_EQ(hu_of(-40.6), -41);
  EXPECT_EQ(hu_of(-5000.0), kAirHu);
  EXPECT_EQ(hu_of(1e9), 32767);
}

TEST(Analytic, classes_are_named_once_and_zero_is_none) {
  AnalyticVolume analytic;
  analytic.size_voxels = {4, 1, 1};
  const auto at = [](double x) { return Sphere{{x, 0.0, 0.0}, 0.4}; };
  analytic.shapes = {{at(0.0), 1.0, "liver"}, {at(1.0), 2.0, "kidney"}, {at(2.0), 3.0, "liver"}, {at(3.0), 4.0}};
  LabelMap labels;
  (void)rasterize(analytic, labels);
  EXPECT_EQ(labels.names, (std::vector<std::string>{"none", "liver", "kidney"}));
  EXPECT_EQ(labels.label, (std::vector<std::uint8_t>{1, 2, 1, 0}));
}

TEST(Analytic, shapes_outside_the_volume_or_larger_than_it_are_harmless) {
  std::vector<Shape> shapes;
  for (const double far : {-1e9, -500.0, 500.0, 1e9}) shapes.push_back({Sphere{glm::dvec3(far), 3.0}, 1.0, "far"});
  shapes.push_back({Sphere{glm::dvec3(15.0), 1e6}, 77.0, "all"});
  shapes.push_back({Cylinder{{-1e5, 15.0, 15.0}, {1e5, 15.0, 15.0}, 4.0}, 78.0, "through"});
  expect_as_painted_point_by_point(scene_of(shapes, glm::dvec3(1.0)));
}

}  // namespace
}  // namespace seldinger::volume
