// Tests of sim/case/skin_passage.
#include "sim/case/skin_passage.h"

#include <gtest/gtest.h>

#include <cmath>

#include "sim/base/rng.h"
#include "tests/fixtures/meshes.h"

namespace seldinger::cases {
namespace {

const glm::dvec3 kDown(0.0, 1.0, 0.0);

TEST(SkinPassage, EntersWhereTheStraightWayCrossesTheSkin) {
  const MeshIndex skin(fixtures::box_mesh({-50, 0, -50}, {50, 100, 50}));
  SkinPassage passage = start_passage(skin, {1, -7, 2}, kDown);
  EXPECT_FALSE(passage.in_body);
  EXPECT_NEAR(passage.depth_mm, -7.0, 1e-9);
  advance_passage(skin, {4, 3, 2}, passage);
  EXPECT_TRUE(passage.in_body);
  EXPECT_NEAR(passage.depth_mm, 3.0, 1e-9);
  EXPECT_NEAR(passage.entry_lps_mm.x, 3.1, 1e-9);
  EXPECT_NEAR(passage.entry_lps_mm.y, 0.0, 1e-9);
  advance_passage(skin, {4, -1.5, 2}, passage);
  EXPECT_FALSE(passage.in_body);
  EXPECT_NEAR(passage.depth_mm, -1.5, 1e-9);
}

TEST(SkinPassage, ACapAtTheVolumesEndLetsNothingInOrOut) {
  const MeshIndex skin(fixtures::box_mesh({-50, 0, -50}, {50, 100, 50}, true));
  SkinPassage passage = start_passage(skin, {0, 50, 60}, {0, 0, -1});
  advance_passage(skin, {0, 50, 40}, passage);
  EXPECT_TRUE(passage.geometric_inside);
  EXPECT_FALSE(passage.in_body) << "came in through a cap";
  EXPECT_LT(passage.depth_mm, 0.0);

  passage = start_passage(skin, {0, -5, 40}, kDown);
  advance_passage(skin, {0, 5, 40}, passage);
  advance_passage(skin, {0, 50, 60}, passage);
  EXPECT_TRUE(passage.in_body) << "the patient goes on beyond the scan";
  EXPECT_GT(passage.depth_mm, 0.0);
}

TEST(SkinPassage, WhatStartsInsideHasTheSkinBehindTheShaftAsItsEntry) {
  const MeshIndex skin(fixtures::box_mesh({-50, 0, -50}, {50, 100, 50}));
  const SkinPassage passage = start_passage(skin, {0, 30, 0}, kDown);
  EXPECT_TRUE(passage.in_body);
  EXPECT_NEAR(passage.entry_lps_mm.y, 0.0, 1e-9);
}

TEST(SkinPassage, FarFromTheSkinDepthIsWithinItsBoundAndNearItExact) {
  const MeshIndex skin(fixtures::sphere_mesh({0, 0, 0}, 50.0, 4, 3.0));
  base::Rng rng(1);
  glm::dvec3 tip(0, -80, 0), velocity(0.0);
  SkinPassage passage = start_passage(skin, tip, kDown);
  int inside = 0, asked = 0;
  for (int i = 0; i < 40'000; ++i) {
    // A wandering tip that is drawn to the surface, at up to some 100 mm/s.
    velocity = velocity * 0.99 + glm::dvec3(rng.normal(), rng.normal(), rng.normal()) * 0.01 - tip * 1e-5;
    tip += velocity;
    const glm::dvec3 before = passage.asked_lps_mm;
    advance_passage(skin, tip, passage);
    asked += passage.asked_lps_mm != before ? 1 : 0;
    const double depth_mm = -skin.closest(tip).distance_mm;
    ASSERT_EQ(passage.in_body, depth_mm > 0.0) << i;
    ASSERT_NEAR(passage.depth_mm, depth_mm, std::abs(depth_mm) > kFarMm - kStaleMm ? kStaleMm : 1e-9) << i;
    inside += passage.in_body ? 1 : 0;
  }
  EXPECT_GT(inside, 1000);
  EXPECT_LT(inside, 39'000);
  EXPECT_LT(asked, 39'000) << "the bound saves something";
}

TEST(SkinPassage, AnEmptySkinHasNoInside) {
  const MeshIndex none;
  SkinPassage passage = start_passage(none, {0, 0, 0}, kDown);
  advance_passage(none, {0, 1, 0}, passage);
  EXPECT_FALSE(passage.in_body);
}

}  // namespace
}  // namespace seldinger::cases
