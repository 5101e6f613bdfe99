// Tests of assessment/operators: plans, the lesion rule, profiles.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "assessment/operators/lesion_site.h"
#include "assessment/operators/plan.h"
#include "assessment/operators/profile.h"
#include "sim/volume/analytic.h"
#include "tests/fixtures/meshes.h"

namespace seldinger::assessment {
namespace {

// A ball of soft tissue with a bone plate above (−y) the target and gas on one side.
volume::Volume ball(std::vector<volume::Shape> inside) {
  volume::AnalyticVolume analytic;
  analytic.size_voxels = {120, 120, 120};
  analytic.spacing_mm = {2, 2, 2};
  analytic.origin_mm = {-119, -119, -119};
  analytic.shapes.push_back({volume::Sphere{{0, 0, 0}, 100.0}, 60.0, ""});
  for (auto& shape : inside) analytic.shapes.push_back(std::move(shape));
  return volume::rasterize(analytic);
}

const cases::MeshIndex& skin() {
  static const cases::MeshIndex kIndex(fixtures::sphere_mesh({0, 0, 0}, 100.0, 5));
  return kIndex;
}

TEST(PlanPuncture, TakesTheShortestFreeWay) {
  const auto plan = plan_puncture(ball({}), skin(), {0, -50, 0});
  ASSERT_TRUE(plan.has_value());
  EXPECT_NEAR(plan->depth_mm, 50.0, 2.0);
  EXPECT_NEAR(glm::length(plan->entry_lps_mm), 100.0, 0.5);
  EXPECT_NEAR(glm::length(plan->entry_lps_mm + plan->direction * plan->depth_mm - plan->target_lps_mm), 0.0, 1e-9);
}

TEST(PlanPuncture, GoesAroundBoneAndGas) {
  const auto volume = ball({{volume::Box{{-30, -85, -30}, {30, -75, 30}}, 900.0, ""},
                            {volume::Box{{20, -60, -60}, {60, -20, 60}}, -950.0, ""}});
  const auto plan = plan_puncture(volume, skin(), {0, -50, 0});
  ASSERT_TRUE(plan.has_value());
  const glm::dmat4 voxel_from_lps = volume::voxel_from_lps(volume);
  for (double s = 4.0; s < plan->depth_mm; s += 0.5) {
    const glm::dvec3 p = plan->entry_lps_mm + plan->direction * s;
    const auto hu = volume::sample_nearest(volume, glm::dvec3(voxel_from_lps * glm::dvec4(p, 1.0)));
    ASSERT_TRUE(hu.has_value());
    EXPECT_EQ(*hu, 60) << "at " << s << " mm";
  }
}

TEST(PlanPuncture, TheProbeStandsOnSkinAndItsPlaneHoldsTheWay) {
  const auto plan = plan_puncture(ball({}), skin(), {20, -40, 10});
  ASSERT_TRUE(plan.has_value());
  const glm::dvec3 normal = glm::cross(plan->probe.side, plan->probe.axis);
  EXPECT_NEAR(glm::dot(plan->probe.side, plan->probe.axis), 0.0, 1e-9);
  EXPECT_NEAR(glm::dot(plan->target_lps_mm - plan->probe.position_lps_mm, normal), 0.0, 1e-6);
  EXPECT_NEAR(glm::dot(plan->entry_lps_mm - plan->probe.position_lps_mm, normal), 0.0, 1e-6);
  EXPECT_NEAR(skin().closest(plan->probe.position_lps_mm).distance_mm, 0.0, 1e-6);
}

TEST(PlanPuncture, ATargetShutInBoneHasNone) {
  const auto volume =
      ball({{volume::Sphere{{0, -50, 0}, 30.0}, 900.0, ""}, {volume::Sphere{{0, -50, 0}, 20.0}, 60.0, ""}});
  const auto plan = plan_puncture(volume, skin(), {0, -50, 0});
  ASSERT_FALSE(plan.has_value());
  EXPECT_EQ(plan.error().code, "no_path");
  EXPECT_FALSE(plan_puncture(volume, cases::MeshIndex(), {0, -50, 0}).has_value());
}

TEST(PlanPuncture, NeverEntersTheBackOfASupinePatient) {
  const auto plan = plan_puncture(ball({}), skin(), {0, 60, 0});
  ASSERT_TRUE(plan.has_value());
  EXPECT_GT(plan->direction.y, -0.31);
  EXPECT_LT(plan->probe.axis.y * -1.0, 0.31);
}

TEST(FindLesionSite, KeepsItsRule) {
  const auto volume =
      ball({{volume::Sphere{{0, -30, 0}, 35.0}, 110.0, ""}, {volume::Sphere{{0, 40, 0}, 30.0}, 400.0, ""}});
  const LesionRule rule;
  const auto site = find_lesion_site(volume, skin(), rule);
  ASSERT_TRUE(site.has_value());
  EXPECT_GE(site->skin_distance_mm, rule.min_depth_mm);
  EXPECT_LE(site->skin_distance_mm, rule.max_depth_mm);
  EXPECT_NEAR(site->skin_distance_mm, 100.0 - glm::length(site->lesion.center_lps_mm), 1.0);
  EXPECT_LE(site->plan.depth_mm, rule.max_depth_mm);
  EXPECT_EQ(site->lesion.radius_mm, 6.0);
  EXPECT_NEAR(site->sd_hu, 0.0, 1e-6) << "wholly inside one tissue";
}

TEST(FindLesionSite, AVolumeOfAirHasNone) {
  volume::AnalyticVolume air;
  air.size_voxels = {40, 40, 40};
  air.spacing_mm = {4, 4, 4};
  const auto site = find_lesion_site(volume::rasterize(air), skin());
  ASSERT_FALSE(site.has_value());
  EXPECT_EQ(site.error().code, "no_lesion_site");
}

TEST(Profiles, NamesAndFiles) {
  for (const char* name : {"novice", "intermediate", "expert"}) EXPECT_TRUE(named_profile(name).has_value());
  EXPECT_FALSE(named_profile("surgeon").has_value());
  const auto custom = profile_from_json(R"({"name": "steady", "tremor_mm": 0.0, "max_redirections": 2})");
  ASSERT_TRUE(custom.has_value());
  EXPECT_EQ(custom->tremor_mm, 0.0);
  EXPECT_EQ(custom->max_redirections, 2);
  for (const char* bad : {"", "[]", "{\"tremor_mm\": \"x\"}", "{\"tremor_mm\": -1}", "{\"hands\": 2}", "{"})
    EXPECT_EQ(profile_from_json(bad).error().code, "bad_operator") << bad;
}

}  // namespace
}  // namespace seldinger::assessment
