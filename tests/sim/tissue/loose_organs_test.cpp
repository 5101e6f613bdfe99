// Organs as balls of their volume, against balls that are drawn: middle and radius, sides, and what is too small.
#include "sim/tissue/loose_organs.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

namespace seldinger::tissue {
namespace {

using volume::TissueClass;

class LooseOrgans : public testing::Test {
 protected:
  LooseOrgans() {
    scene_.volume = volume::make_volume({100, 60, 60}, glm::dvec3(4.0), glm::dmat3(1.0), {-200.0, -120.0, -120.0});
    scene_.classes.assign(scene_.volume.hu.size(), TissueClass::fat);
    scene_.skin.vertices_lps_mm = {{-200.0F, 0.0F, 0.0F}, {200.0F, 0.0F, 0.0F}, {0.0F, 120.0F, 0.0F}};
  }
  void ball(TissueClass tissue, const glm::dvec3& middle_lps_mm, double radius_mm) {
    const glm::ivec3 size = scene_.volume.size_voxels;
    for (int k = 0; k < size.z; ++k)
      for (int j = 0; j < size.y; ++j)
        for (int i = 0; i < size.x; ++i) {
          const glm::dvec3 p_lps_mm(scene_.volume.lps_from_voxel * glm::dvec4(i, j, k, 1.0));
          if (glm::distance(p_lps_mm, middle_lps_mm) <= radius_mm)
            scene_.classes[scene_.volume.index(i, j, k)] = tissue;
        }
  }
  cases::Case scene_;
};

TEST_F(LooseOrgans, AreWhereTheyWereDrawnAndAsLarge) {
  const glm::dvec3 liver{-90.0, -10.0, 20.0}, right{-60.0, 70.0, -60.0}, left{70.0, 72.0, -50.0};
  ball(TissueClass::liver, liver, 60.0);
  ball(TissueClass::kidney, right, 33.0);
  ball(TissueClass::kidney, left, 30.0);
  const std::vector<LooseOrgan> found = loose_organs(scene_);
  ASSERT_EQ(found.size(), 3U);
  const auto expect = [&](TissueClass tissue, const glm::dvec3& middle_lps_mm, double radius_mm) {
    int of_it = 0;
    for (const LooseOrgan& one : found) {
      if (one.tissue != tissue || glm::distance(one.middle_lps_mm, middle_lps_mm) > 10.0) continue;
      ++of_it;
      EXPECT_LT(glm::distance(one.middle_lps_mm, middle_lps_mm), 1.0);  // a quarter of a voxel
      EXPECT_NEAR(one.radius_mm, radius_mm, 1.0);
    }
    EXPECT_EQ(of_it, 1);
  };
  expect(TissueClass::liver, liver, 60.0);
  expect(TissueClass::kidney, right, 33.0);
  expect(TissueClass::kidney, left, 30.0);
}

// Liver and spleen are one each, whatever side they reach over to.
TEST_F(LooseOrgans, AreSplitBySidesOnlyWhereThereAreTwo) {
  ball(TissueClass::spleen, {0.0, 0.0, 0.0}, 40.0);
  const std::vector<LooseOrgan> found = loose_organs(scene_);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_LT(glm::length(found.front().middle_lps_mm), 1.0);
}

TEST_F(LooseOrgans, WhatIsTooSmallOrUnknownIsNone) {
  ball(TissueClass::kidney, {60.0, 0.0, 0.0}, 13.0);  // 9 ml
  EXPECT_TRUE(loose_organs(scene_).empty());
  ball(TissueClass::kidney, {60.0, 0.0, 0.0}, 20.0);
  EXPECT_EQ(loose_organs(scene_).size(), 1U);
  scene_.skin.vertices_lps_mm.clear();
  EXPECT_TRUE(loose_organs(scene_).empty());
  scene_.skin.vertices_lps_mm = {{0.0F, 0.0F, 0.0F}};
  scene_.classes.clear();
  EXPECT_TRUE(loose_organs(scene_).empty());
}

}  // namespace
}  // namespace seldinger::tissue
