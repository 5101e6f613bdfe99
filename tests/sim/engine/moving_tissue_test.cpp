// Tests of sim/engine/moving_tissue: nothing moves unless the scene asks for it, and then tools are told at rest.
#include "sim/engine/moving_tissue.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <glm/geometric.hpp>

#include "sim/engine/step.h"
#include "tests/fixtures/meshes.h"

namespace seldinger::engine {
namespace {

cases::Case body() {
  cases::Case scene;
  scene.skin = fixtures::sphere_mesh({0, 0, 0}, 100.0, 5);
  scene.skin_index = cases::MeshIndex(scene.skin);
  return scene;
}

TEST(MovingTissue, OfAStillSceneHasNoSource) {
  const cases::Case scene = body();
  const MovingTissue tissue(scene);
  haptics::HandStates hands{};
  hands[0].tool = haptics::Tool::probe;
  hands[0].probe.press.depth_mm = 8.0;
  cases::State state;
  state.breath.level = 1.0;
  EXPECT_FALSE(tissue.moves());
  EXPECT_EQ(tissue::count_sources(tissue.seen(state, hands)), 0);
  const cases::ToolPose pose{{1.0, 2.0, 3.0}, {0.0, 1.0, 0.0}, {1.0, 0.0, 0.0}};
  EXPECT_EQ(at_rest({}, pose, 20.0).position_lps_mm, pose.position_lps_mm);
}

TEST(MovingTissue, AProbeClosesTheScenesVeinsWhereTissueYields) {
  cases::Case scene = body();
  for (const char* name : {"jugular_vein", "carotid"})
    scene.structures.push_back({name, volume::TissueClass::vessel, cases::StructureRule::critical,
                                cases::Tube{{{-60, -78, 0}, {60, -78, 0}}, 5.0}});
  haptics::HandStates hands{};
  hands[0].tool = haptics::Tool::probe;
  hands[0].probe.press = {.at_lps_mm = {0, -100, 0}, .inward = {0, 1, 0}, .radius_mm = 20.0, .depth_mm = 6.0};
  const cases::State state;
  EXPECT_TRUE(MovingTissue(scene).veins().empty()) << "a still scene has none";
  scene.yields = true;
  const MovingTissue tissue(scene);
  ASSERT_EQ(tissue.veins().size(), 1U);
  EXPECT_EQ(tissue.veins()[0].name, "jugular_vein");
  const tissue::Displacement seen = tissue.seen(state, hands);
  EXPECT_EQ(tissue::count_sources(seen), 2) << "the press and one vein";
  const double ap_mm = tissue::displaced(seen, {0, -73, 0}).y - tissue::displaced(seen, {0, -83, 0}).y;
  EXPECT_LT(ap_mm, 2.0) << "of 10";
  EXPECT_EQ(tissue::count_sources(tissue.felt_by_needle(state, hands)), 2);
  EXPECT_EQ(tissue::count_sources(tissue.felt_by_probe(state)), 0);
}

TEST(MovingTissue, EachHandFindsWhatTheOthersDo) {
  cases::Case scene = body();
  scene.yields = true;
  scene.breathing.emplace();
  const MovingTissue tissue(scene);
  ASSERT_TRUE(tissue.moves());
  haptics::HandStates hands{};
  hands[0].tool = haptics::Tool::probe;
  hands[0].probe.press = {.at_lps_mm = {0, -100, 0}, .inward = {0, 1, 0}, .radius_mm = 20.0, .depth_mm = 6.0};
  hands[1].tool = haptics::Tool::needle;
  hands[1].needle.drag = {.entry_lps_mm = {40, -90, 0},
                          .direction = {0, 1, 0},
                          .cut_mm = 40.0,
                          .tip_n = 0.5,
                          .tip_mm = 1.0,
                          .shaft_mm = 0.5};
  cases::State state;
  EXPECT_EQ(tissue::count_sources(tissue.felt_by_probe(state)), 0) << "breathed out, breath moves nothing";
  EXPECT_EQ(tissue::count_sources(tissue.felt_by_needle(state, hands)), 1) << "the press, not its own drag";
  EXPECT_EQ(tissue::count_sources(tissue.seen(state, hands)), 3) << "press, tip and shaft";
  state.breath.level = 0.5;
  EXPECT_EQ(tissue::count_sources(tissue.felt_by_probe(state)), 1);
  EXPECT_EQ(tissue::count_sources(tissue.seen(state, hands)), 4);
  scene.yields = false;
  EXPECT_EQ(tissue::count_sources(tissue.seen(state, hands)), 1);
}

// By the newest law of breath organs slide along the wall, where classes tell one; by the laws of before pictures
// show what they showed, bit for bit.
TEST(MovingTissue, OrgansSlideOnlyWhereTheCaseSaysSo) {
  cases::Case scene = body();
  scene.volume = volume::make_volume({61, 61, 31}, glm::dvec3(4.0), glm::dmat3(1.0), {-120.0, -120.0, -60.0});
  for (int k = 0; k < 31; ++k)
    for (int j = 0; j < 61; ++j)
      for (int i = 0; i < 61; ++i) {
        const double from_axis = glm::length(glm::dvec2(4.0 * i - 120.0, 4.0 * j - 120.0));
        const bool spine = std::abs(4.0 * i - 120.0) < 10.0 && std::abs(4.0 * j - 180.0) < 10.0;
        const bool sternum = std::abs(4.0 * i - 120.0) < 10.0 && std::abs(4.0 * j - 50.0) < 6.0;
        scene.classes.push_back(from_axis > 90.0   ? volume::TissueClass::air
                                : spine || sternum ? volume::TissueClass::bone
                                : from_axis > 70.0 ? volume::TissueClass::muscle
                                                   : volume::TissueClass::liver);
      }
  scene.breathing.emplace();
  cases::State state;
  state.breath.level = 1.0;
  const auto seen = [&] { return MovingTissue(scene).seen(state, {}); };
  const tissue::Displacement before = seen();
  scene.breathing->slides = true;
  const tissue::Displacement now = seen();
  EXPECT_NE(std::memcmp(&before, &now, sizeof now), 0);
  const auto down_mm = [](const tissue::Displacement& d, double x_mm) {
    return -tissue::displaced(d, {x_mm, -20, 0}).z;
  };
  EXPECT_GT(down_mm(before, 78.0), 0.5);
  EXPECT_EQ(down_mm(now, 78.0), 0.0) << "of the wall";
  EXPECT_GT(down_mm(now, 50.0), down_mm(before, 50.0)) << "of what touches it";
  scene.classes.clear();  // without classes there is no wall to be told
  const tissue::Displacement untold = seen();
  scene.breathing->slides = false;
  const tissue::Displacement same = seen();
  EXPECT_EQ(std::memcmp(&untold, &same, sizeof same), 0);
}

// By the newest law of touch the kidney that the needle presses goes along and turns, the other does not; by the
// laws of before, which published cases keep, pictures show what they showed, bit for bit.
TEST(MovingTissue, AnOrganThatIsPressedGivesWayByTheNewestLaw) {
  cases::Case scene = body();
  scene.volume = volume::make_volume({61, 31, 31}, glm::dvec3(3.0), glm::dmat3(1.0), {-90.0, -45.0, -45.0});
  for (int k = 0; k < 31; ++k)
    for (int j = 0; j < 31; ++j)
      for (int i = 0; i < 61; ++i) {
        const glm::dvec3 p = glm::dvec3(i, j, k) * 3.0 - glm::dvec3(90.0, 45.0, 45.0);
        const bool kidney = glm::length(p - glm::dvec3(p.x < 0.0 ? -50.0 : 50.0, 0.0, 0.0)) < 30.0;
        scene.classes.push_back(kidney ? volume::TissueClass::kidney : volume::TissueClass::fat);
      }
  scene.yields = true;
  haptics::HandStates hands{};
  hands[1].tool = haptics::Tool::needle;
  hands[1].needle.drag = {.entry_lps_mm = {60, -90, 0},
                          .direction = {0, 1, 0},
                          .cut_mm = 62.0,
                          .tip_n = 2.0,
                          .tip_mm = 7.0,
                          .organ = volume::TissueClass::kidney,
                          .organ_n = 2.0};
  const cases::State state;
  const auto seen = [&](cases::TouchLaw law) {
    scene.touch.law = law;
    return MovingTissue(scene).seen(state, hands);
  };
  const tissue::Displacement before = seen(cases::TouchLaw::by_speed), now = seen(cases::kNewestTouchLaw);
  EXPECT_EQ(tissue::count_sources(before), 1) << "the tip";
  EXPECT_EQ(tissue::count_sources(now), 2);
  const auto way = [](const tissue::Displacement& moved, const glm::dvec3& rest_mm) {
    return tissue::displaced(moved, rest_mm) - rest_mm;
  };
  const glm::dvec3 tip_mm(60, -28, 0), far_side_mm(50, 25, 0), other_mm(-50, 0, 0);
  EXPECT_NEAR(way(now, tip_mm).y, way(before, tip_mm).y, 1e-4) << "tissue at the tip is at the tip";
  EXPECT_GT(way(now, far_side_mm).y, way(before, far_side_mm).y + 1.5) << "mm, the far side with it";
  EXPECT_LT(glm::length(way(now, other_mm)), 0.3);
  EXPECT_GT(way(now, {70, 0, 0}).y, way(now, {30, 0, 0}).y) << "pressed at its side, it turns";
  hands[1].needle.drag.organ_n = 0.0;
  EXPECT_EQ(tissue::count_sources(seen(cases::kNewestTouchLaw)), 1) << "on its way there it moves none";
}

TEST(MovingTissue, ANeedleThatRestsIsMovedThroughTheTissueByBreath) {
  cases::Case scene = body();
  scene.breathing.emplace();
  const MovingTissue tissue(scene);
  cases::State state;
  cases::Inputs inputs;
  inputs.needle = {{0.3, -40.0, 0.3}, {0, 1, 0}, {1, 0, 0}};
  const haptics::HandStates hands{};
  double least_mm = 1e9, most_mm = -1e9, z_least_mm = 1e9, z_most_mm = -1e9;
  for (int tick = 0; tick < 8000; ++tick) {
    step(scene, inputs, 0.001, tissue.felt_by_needle(state, hands), state);
    EXPECT_EQ(state.needle.tip_lps_mm, inputs.needle.position_lps_mm) << "the tool is where the hand holds it";
    const glm::dvec3& rest = state.needle.skin.tip_lps_mm;
    least_mm = std::min(least_mm, rest.y);
    most_mm = std::max(most_mm, rest.y);
    z_least_mm = std::min(z_least_mm, rest.z);
    z_most_mm = std::max(z_most_mm, rest.z);
  }
  EXPECT_TRUE(state.needle.skin.in_body);
  EXPECT_GT(z_most_mm - z_least_mm, 1.0) << "tissue goes down and up past the tip";
  EXPECT_LT(z_most_mm - z_least_mm, 20.0);
  EXPECT_NEAR(z_least_mm, 0.3, 0.01) << "breathed out is where the CT was";
  EXPECT_GT(most_mm - least_mm, 0.5);
}

TEST(MovingTissue, ABreathCountsInTheHashOfWhoBreathesAlone) {
  cases::Case still = body(), breathing = body();
  breathing.breathing.emplace();
  cases::State a, b;
  for (int tick = 0; tick < 50; ++tick) {
    step(still, {}, 0.001, a);
    step(breathing, {}, 0.001, b);
  }
  EXPECT_NE(cases::state_hash(a, 0), cases::state_hash(b, 0));
  cases::State c = a;
  c.breath.state.phase += 0.1;
  EXPECT_EQ(cases::state_hash(a, 0), cases::state_hash(c, 0));
  c = b;
  c.breath.state.phase += 0.1;
  EXPECT_NE(cases::state_hash(b, 0), cases::state_hash(c, 0));
}

}  // namespace
}  // namespace seldinger::engine
