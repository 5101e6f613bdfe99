// Lesions as they are asked for: closed forms of ellipsoids, and what seeded noise keeps of its radius.
#include "sim/case/lesion_form.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "sim/base/rng.h"

namespace seldinger::cases {
namespace {

LesionForm irregular(double radius_mm, double roughness, std::uint64_t seed) {
  LesionForm form;
  form.outline = LesionOutline::irregular;
  form.center_lps_mm = {10, -20, 30};
  form.radii_mm = glm::dvec3(radius_mm);
  form.roughness = roughness;
  form.seed = seed;
  return form;
}

glm::dvec3 direction(base::Rng& rng) {
  const double x = rng.normal(), y = rng.normal();
  return glm::normalize(glm::dvec3(x, y, rng.normal()));
}

TEST(LesionFormTest, APlainSphereIsDrawnAllOthersLieInTheVolume) {
  LesionForm form;
  form.radii_mm = glm::dvec3(6.0);
  form.hu = 20.0;
  EXPECT_FALSE(lesion_of(form).in_volume());
  EXPECT_EQ(lesion_of(form).radius_mm, 6.0);
  form.edge_mm = 2.0;
  EXPECT_TRUE(lesion_of(form).in_volume());
  form.edge_mm = 0.0;
  form.adds = true;
  EXPECT_TRUE(lesion_of(form).in_volume());
  EXPECT_EQ(std::get<Sphere>(shape_of(lesion_of(form))).radius_mm, 6.0);
}

TEST(LesionFormTest, AnEllipsoidCountsAsTheBallOfItsVolume) {
  LesionForm form;
  form.outline = LesionOutline::ellipsoid;
  form.radii_mm = {4, 6, 9};
  const Lesion lesion = lesion_of(form);
  EXPECT_NEAR(lesion.radius_mm, 6.0, 1e-12);
  EXPECT_NEAR(signed_distance_mm(shape_of(lesion), {4, 0, 0}, 50.0), 0.0, 1e-9);
  EXPECT_NEAR(signed_distance_mm(shape_of(lesion), {0, 0, 12}, 50.0), 3.0, 1e-9);
}

TEST(LesionFormTest, WithoutRoughnessItIsASphere) {
  const Shape shape = shape_of(irregular(8.0, 0.0, 3));
  base::Rng rng(1);
  for (int i = 0; i < 200; ++i) {
    const glm::dvec3 d = direction(rng);
    const double away = 16.0 * rng.uniform();
    const double voxel_mm = 8.0 / 24.0;
    EXPECT_NEAR(signed_distance_mm(shape, glm::dvec3(10, -20, 30) + away * d, 50.0), away - 8.0, voxel_mm);
  }
  EXPECT_NEAR(lesion_of(irregular(8.0, 0.0, 3)).radius_mm, 8.0, 0.02);
}

// The surface lies where the radius of its direction says, the radius keeps its mean and spread, and a line through
// the middle is inside for the sum of two radii.
TEST(LesionFormTest, IrregularIsAsRoughAsAsked) {
  constexpr double kRadius = 10.0, kRough = 0.12;
  double sum = 0.0, sum2 = 0.0;
  int count = 0;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    base::Rng rng(seed);
    for (int i = 0; i < 100; ++i, ++count) {
      const double r = irregular_radius_mm(irregular(kRadius, kRough, seed), direction(rng)) / kRadius;
      sum += r;
      sum2 += r * r;
    }
  }
  const double mean = sum / count, sd = std::sqrt(sum2 / count - mean * mean);
  EXPECT_NEAR(mean, 1.0, 0.02);
  EXPECT_NEAR(sd, kRough, 0.015);

  const LesionForm form = irregular(kRadius, kRough, 7);
  const Shape shape = shape_of(form);
  base::Rng rng(5);
  for (int i = 0; i < 60; ++i) {
    const glm::dvec3 d = direction(rng);
    const double here = irregular_radius_mm(form, d), there = irregular_radius_mm(form, -d);
    const glm::dvec3 at = form.center_lps_mm;
    EXPECT_LT(signed_distance_mm(shape, at + (here - 0.8) * d, 5.0), 0.0);
    EXPECT_GT(signed_distance_mm(shape, at + (here + 0.8) * d, 5.0), 0.0);
    double inside = 0.0;
    for (const Stretch& part : stretches_inside(shape, at - 30.0 * d, at + 30.0 * d))
      inside += 60.0 * (part.to - part.from);
    EXPECT_NEAR(inside, here + there, 1.0);
  }
  EXPECT_NE(irregular_radius_mm(form, {1, 0, 0}), irregular_radius_mm(irregular(kRadius, kRough, 8), {1, 0, 0}));
}

}  // namespace
}  // namespace seldinger::cases
