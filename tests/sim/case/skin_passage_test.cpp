// Tests of sim/case/skin_passage.
#include "sim/case/skin_passage.h"

#include <gtest/gtest.h>

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

TEST(SkinPassage, AnEmptySkinHasNoInside) {
  const MeshIndex none;
  SkinPassage passage = start_passage(none, {0, 0, 0}, kDown);
  advance_passage(none, {0, 1, 0}, passage);
  EXPECT_FALSE(passage.in_body);
}

}  // namespace
}  // namespace seldinger::cases
