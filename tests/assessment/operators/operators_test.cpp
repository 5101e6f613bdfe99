// Tests of assessment/operators: plans, the lesion rule, profiles.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>
#include <numbers>

#include "assessment/operators/lesion_site.h"
#include "assessment/operators/plan.h"
#include "assessment/operators/probe_over.h"
#include "assessment/operators/profile.h"
#include "assessment/operators/scripted.h"
#include "sim/volume/analytic.h"
#include "tests/fixtures/ball_case.h"

namespace seldinger::assessment {
namespace {

// A ball of soft tissue with a bone plate above (−y) the target and gas on one side.
volume::Volume ball(std::vector<volume::Shape> inside) {
  return fixtures::ball_volume({120, 2.0, 100.0, 60.0, 5, std::move(inside)});
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

// An arterial aorta is denser than a rib of thick slices.
TEST(PlanPuncture, WhatIsBoneIsToldByClassWhereOneIsKnown) {
  const volume::Box plate{{-30, -85, -30}, {30, -75, 30}};
  for (const bool bone : {false, true}) {
    const auto volume = ball({{plate, bone ? 250.0 : 412.0, ""}});
    std::vector<volume::TissueClass> classes(volume.hu.size(), volume::TissueClass::soft_tissue);
    for (std::size_t i = 0; i < classes.size(); ++i)
      if (volume.hu[i] > 200) classes[i] = bone ? volume::TissueClass::bone : volume::TissueClass::vessel;
    PathLimits limits;
    const auto by_hu = plan_puncture(volume, skin(), {0, -50, 0}, limits);
    limits.classes = classes;
    const auto by_class = plan_puncture(volume, skin(), {0, -50, 0}, limits);
    ASSERT_TRUE(by_hu && by_class);
    const auto meets_plate = [&](const PuncturePlan& plan) {
      for (double s = 0.0; s < plan.depth_mm; s += 0.5) {
        const glm::dvec3 p = plan.entry_lps_mm + plan.direction * s;
        if (glm::all(glm::greaterThan(p, plate.min_mm)) && glm::all(glm::lessThan(p, plate.max_mm))) return true;
      }
      return false;
    };
    EXPECT_EQ(meets_plate(*by_hu), bone) << "what this is for";
    EXPECT_EQ(meets_plate(*by_class), !bone);
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

TEST(PlanPuncture, TakesTheProbesPlaceFromWhoLooks) {
  PathLimits limits;
  int asked = 0;
  // Worth the more, the nearer to a place; held 7 mm deeper.
  const glm::dvec3 liked(40, -80, 10);
  limits.looks_from = [&](const PuncturePlan& plan, const WorthTaking& worth) -> std::optional<ProbeView> {
    ++asked;
    if (plan.probe.position_lps_mm.x < 0.0) return std::nullopt;
    ProbeView view;
    view.probe = plan.probe;
    view.probe.position_lps_mm += 7.0 * plan.probe.axis;
    view.picture.probe = "some";
    view.needle_mm = plan.depth_mm - 10.0 * glm::length(plan.probe.position_lps_mm - liked);
    view.tip_shows_from_mm = 12.0;
    if (!worth(view)) return std::nullopt;
    return view;
  };
  const auto plan = plan_puncture(ball({}), skin(), {0, -50, 0}, limits);
  ASSERT_TRUE(plan.has_value());
  EXPECT_GT(asked, 100);
  const glm::dvec3 touching = plan->probe.position_lps_mm - 7.0 * plan->probe.axis;
  EXPECT_NEAR(skin().closest(touching).distance_mm, 0.0, 1e-6);
  EXPECT_LT(glm::length(touching - liked), 25.0);
  EXPECT_EQ(plan->tip_shows_from_mm, 12.0);
  ASSERT_TRUE(plan->picture.has_value());
  EXPECT_EQ(plan->picture->probe, "some");
  limits.looks_from = [](const PuncturePlan&, const WorthTaking&) { return std::optional<ProbeView>(); };
  EXPECT_EQ(plan_puncture(ball({}), skin(), {0, -50, 0}, limits).error().code, "no_path");
}

TEST(PlanPuncture, OutOfPlaneTheProbeStandsAcrossTheWay) {
  PathLimits limits;
  limits.approach = cases::Approach::out_of_plane;
  const auto plan = plan_puncture(ball({}), skin(), {0, -60, 0}, limits);
  ASSERT_TRUE(plan.has_value());
  EXPECT_EQ(plan->approach, cases::Approach::out_of_plane);
  const glm::dvec3 normal = plane_normal(plan->probe);
  EXPECT_NEAR(glm::dot(plan->target_lps_mm - plan->probe.position_lps_mm, normal), 0.0, 1e-6) << "holds the target";
  EXPECT_NEAR(glm::dot(plan->direction, plan->probe.side), 0.0, 1e-6);
  EXPECT_GT(std::abs(glm::dot(plan->direction, normal)), 0.4) << "and is crossed by the way";
  EXPECT_GE(std::abs(glm::dot(plan->entry_lps_mm - plan->probe.position_lps_mm, normal)), 8.0 - 1e-9);
  for (const glm::dvec3& place : {plan->probe.position_lps_mm, plan->probe_first.position_lps_mm})
    EXPECT_NEAR(skin().closest(place).distance_mm, 0.0, 1e-6);
  // The plane follows the tip: from where the fan reaches it to the target.
  int held = 0;
  for (double inserted_mm = 0.0; inserted_mm <= plan->depth_mm; inserted_mm += 1.0) {
    const cases::ToolPose probe = probe_over(*plan, inserted_mm);
    EXPECT_NEAR(glm::length(probe.axis), 1.0, 1e-9);
    EXPECT_NEAR(glm::dot(probe.axis, probe.side), 0.0, 1e-6);
    const glm::dvec3 tip = plan->entry_lps_mm + inserted_mm * plan->direction;
    const bool holds = std::abs(glm::dot(tip - probe.position_lps_mm, plane_normal(probe))) < 1e-3;
    EXPECT_TRUE(holds || inserted_mm <= 15.0) << inserted_mm;
    held += holds ? 1 : 0;
  }
  EXPECT_GT(held, 20);
}

TEST(ProbeOver, InPlaneTheProbeIsRockedAsTheNeedleGoesInAndBackAgain) {
  PuncturePlan plan;
  plan.target_lps_mm = {0, -40, 0};
  plan.entry_lps_mm = {-60, -100, 0};
  plan.direction = glm::normalize(plan.target_lps_mm - plan.entry_lps_mm);
  plan.depth_mm = glm::distance(plan.target_lps_mm, plan.entry_lps_mm);
  const auto leaning = [](double deg) {  // towards the needle
    const double by = deg * std::numbers::pi / 180.0;
    return cases::ToolPose{{0, -90, 0}, {-std::sin(by), std::cos(by), 0}, {std::cos(by), std::sin(by), 0}};
  };
  plan.probe_first = leaning(0.0);
  plan.probe = leaning(30.0);
  double before_deg = -1.0;
  for (double inserted_mm = -10.0; inserted_mm <= plan.depth_mm + 10.0; inserted_mm += 1.0) {
    const cases::ToolPose probe = probe_over(plan, inserted_mm);
    EXPECT_NEAR(glm::length(probe.axis), 1.0, 1e-12);
    EXPECT_NEAR(glm::length(probe.side), 1.0, 1e-12);
    EXPECT_NEAR(glm::dot(probe.axis, probe.side), 0.0, 1e-12);
    EXPECT_NEAR(plane_normal(probe).z, 1.0, 1e-12) << "the plane keeps needle and target";
    const double deg = std::acos(std::clamp(probe.axis.y, -1.0, 1.0)) * 180.0 / std::numbers::pi;
    EXPECT_GE(deg, before_deg - 1e-6) << inserted_mm;
    before_deg = deg;
  }
  EXPECT_EQ(probe_over(plan, -1.0).axis, plan.probe_first.axis);
  EXPECT_EQ(probe_over(plan, plan.depth_mm).axis, plan.probe.axis);
  EXPECT_NEAR(std::acos(probe_over(plan, 0.5 * plan.depth_mm).axis.y), 15.0 * std::numbers::pi / 180.0, 1e-9);
  plan.probe_first = plan.probe;
  EXPECT_EQ(probe_over(plan, 5.0).side, plan.probe.side) << "held still, it stands where it was planned to";
}

TEST(PlanPuncture, TellsWhereTheOrganBegins) {
  PathLimits limits;
  const std::vector<cases::Structure> organ = {
      {"liver", volume::TissueClass::soft_tissue, cases::StructureRule::organ, cases::Sphere{{0, -50, 0}, 20.0}}};
  limits.structures = organ;
  const auto plan = plan_puncture(ball({}), skin(), {0, -50, 0}, limits);
  ASSERT_TRUE(plan.has_value());
  EXPECT_NEAR(plan->organ_from_mm, plan->depth_mm - 20.0, 1e-6);
  EXPECT_EQ(plan_puncture(ball({}), skin(), {0, -50, 0})->organ_from_mm, 0.0);
}

TEST(FindLesionSite, UnderUltrasoundItIsACystThatIsSeen) {
  LesionRule rule = lesion_rule(cases::Modality::ultrasound, cases::PatientPosition::supine);
  glm::dvec3 refused(0.0);
  rule.looks_from = [&](const PuncturePlan& plan, const WorthTaking&,
                        const cases::Lesion& target) -> std::optional<ProbeView> {
    EXPECT_EQ(target.hu, 5.0);
    if (refused == glm::dvec3(0.0)) refused = target.center_lps_mm;
    if (target.center_lps_mm == refused) return std::nullopt;
    ProbeView view;
    view.probe = plan.probe;
    return view;
  };
  const auto site = find_lesion_site(ball({}), skin(), rule);
  ASSERT_TRUE(site.has_value());
  EXPECT_EQ(site->lesion.hu, 5.0);
  EXPECT_NE(site->lesion.center_lps_mm, refused);
  EXPECT_TRUE(site->plan.picture.has_value());
}

TEST(ScriptedOperator, GoesOnAfterSearchingForATipThatNeverShows) {
  PuncturePlan plan;
  plan.target_lps_mm = {0, -50, 0};
  plan.entry_lps_mm = {0, -100, 0};
  plan.direction = {0, 1, 0};
  plan.depth_mm = 50.0;
  plan.probe = plan.probe_first = {{40, -90, 0}, {0, 1, 0}, {1, 0, 0}};
  for (const double shows_from_mm : {0.0, 30.0}) {
    plan.tip_shows_from_mm = shows_from_mm;
    ScriptedOperator person(*named_profile("expert"), plan, cases::Instrument{}, 1);
    cases::State state;
    cases::FrameTruth blind;
    double stood_at_mm = -1.0;
    double before_mm = -100.0;
    while (!person.done() && state.t_s < 120.0) {
      state.t_s += 0.001;
      blind.t_s = state.t_s;
      const cases::Inputs inputs = person.act(state, &blind, 0.001);
      state.needle.tip_lps_mm = inputs.needle.position_lps_mm;
      state.needle.direction = inputs.needle.axis;
      // Where the advance pauses for half a second.
      if (static_cast<int>(state.t_s * 1000.0) % 500 == 0) {
        const double depth_mm = state.needle.tip_lps_mm.y + 100.0;
        if (stood_at_mm < 0.0 && depth_mm > 0.0 && depth_mm - before_mm < 1.0) stood_at_mm = depth_mm;
        before_mm = depth_mm;
      }
    }
    EXPECT_TRUE(person.done()) << "nobody waits for ever";
    EXPECT_NEAR(stood_at_mm, shows_from_mm + 1.0, 2.0) << "misses the tip only where it should show";
  }
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

// Two even balls, the right one evener: what is named an organ comes first, and beside both lungs there is no
// place.
TEST(FindLesionSite, LiesInAnOrganThatIsNamed) {
  const auto volume =
      ball({{volume::Sphere{{-40, -20, 0}, 24.0}, 60.0, ""}, {volume::Sphere{{40, -20, 0}, 24.0}, 110.0, ""}});
  volume::Organs organs;
  organs.grid = volume::make_volume({70, 70, 70}, glm::dvec3(3.0), glm::dmat3(1.0), glm::dvec3(-104.0));
  organs.found = {{volume::FoundOrgan::liver, 0.9, 58.0, 60}};
  const auto name = [&](const glm::dvec3& center_mm, double radius_mm, volume::FoundOrgan organ) {
    organs.at.resize(organs.grid.hu.size(), volume::FoundOrgan::none);
    for (int k = 0; k < 70; ++k)
      for (int j = 0; j < 70; ++j)
        for (int i = 0; i < 70; ++i)
          if (glm::length(glm::dvec3(i, j, k) * 3.0 - 104.0 - center_mm) <= radius_mm)
            organs.at[organs.grid.index(i, j, k)] = organ;
  };
  const auto x_mm = [&](const volume::Organs& named) {
    LesionRule rule;
    rule.organs = &named;
    const auto site = find_lesion_site(volume, skin(), rule);
    return site ? site->lesion.center_lps_mm.x : 0.0;
  };
  for (const double side : {-1.0, 1.0}) {
    organs.at.clear();
    name({side * 40, -20, 0}, 24.0, volume::FoundOrgan::liver);
    EXPECT_NEAR(x_mm(organs), side * 40.0, 10.0) << "in the liver";
  }
  // Lungs of every height between the balls.
  organs.at.assign(organs.grid.hu.size(), volume::FoundOrgan::none);
  for (int k = 0; k < 70; ++k) {
    organs.at[organs.grid.index(33, 35, k)] = volume::FoundOrgan::right_lung;
    organs.at[organs.grid.index(36, 35, k)] = volume::FoundOrgan::left_lung;
  }
  EXPECT_LT(std::abs(x_mm(organs)), 10.0);
}

TEST(FindLesionSite, AVolumeOfAirHasNone) {
  volume::AnalyticVolume air;
  air.size_voxels = {40, 40, 40};
  air.spacing_mm = {4, 4, 4};
  const auto site = find_lesion_site(volume::rasterize(air), skin());
  ASSERT_FALSE(site.has_value());
  EXPECT_EQ(site.error().code, "no_lesion_site");
  EXPECT_NE(site.error().text.find("mean 30–180 HU) homogeneous within 16 mm"), std::string::npos)
      << site.error().text;
}

TEST(FindLesionSite, ASlabThinnerThanTheRuleIsToldWithItsNumbers) {
  auto volume = ball({{volume::Sphere{{0, -30, 0}, 35.0}, 110.0, ""}});
  volume.size_voxels.z = static_cast<int>(std::lround(19.0 / volume.spacing_mm.z));
  volume.hu.resize(static_cast<std::size_t>(volume.size_voxels.x) * static_cast<std::size_t>(volume.size_voxels.y) *
                   static_cast<std::size_t>(volume.size_voxels.z));
  const auto site = find_lesion_site(volume, skin());
  ASSERT_FALSE(site.has_value());
  const std::string slab =
      "a slab of " + std::to_string(std::lround(volume.size_voxels.z * volume.spacing_mm.z)) + " mm";
  EXPECT_NE(site.error().text.find(slab), std::string::npos) << site.error().text;
  EXPECT_NE(site.error().text.find("asks for 32 mm"), std::string::npos) << site.error().text;
}

TEST(FindLesionSite, WhatIsHomogeneousAndNotDeepEnoughIsCounted) {
  LesionRule rule;
  rule.min_depth_mm = 99.0;
  rule.max_depth_mm = 99.5;
  const auto site = find_lesion_site(ball({{volume::Sphere{{0, -30, 0}, 35.0}, 110.0, ""}}), skin(), rule);
  ASSERT_FALSE(site.has_value());
  EXPECT_NE(site.error().text.find(" places of homogeneous soft tissue"), std::string::npos) << site.error().text;
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
