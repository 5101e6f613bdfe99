// The blocks of gel as they come out of import: their skin, and the way that is planned in each drill.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "app/cases/import_case.h"
#include "app/demo/demo_cases.h"
#include "sim/case/form/mesh_index.h"

namespace seldinger::app {
namespace {

const casedb::NewCase& block() {
  static const casedb::NewCase made = import_gel_block(volume::GelBlock::out_of_plane).value();
  return made;
}

TEST(GelBlockCase, ItsSkinIsTheFlatTopAndItsWallsCannotBePunctured) {
  const cases::MeshIndex skin(block().skin);
  // The mesh is made of means of two voxels: it lies within half a voxel of the iso-surface of those, which is 0.27
  // mm below the top, and is flat to a tenth.
  double highest_mm = 1e9, lowest_mm = -1e9;
  for (double x = -70.0; x <= 70.0; x += 7.0)
    for (double z = -50.0; z <= 50.0; z += 5.0) {
      const auto top = skin.first_hit({x, 50.0, z}, {0.0, -1.0, 0.0}, 100.0);
      ASSERT_TRUE(top.has_value());
      EXPECT_FALSE(top->cut) << x << " " << z;
      highest_mm = std::min(highest_mm, 50.0 - top->distance_mm);
      lowest_mm = std::max(lowest_mm, 50.0 - top->distance_mm);
    }
  EXPECT_NEAR(0.5 * (highest_mm + lowest_mm), 0.272, 0.5 * block().volume.spacing_mm.y);
  EXPECT_LT(lowest_mm - highest_mm, 0.1);
  for (const glm::dvec3& out : {glm::dvec3(1, 0, 0), glm::dvec3(-1, 0, 0), glm::dvec3(0, 1, 0), glm::dvec3(0, 0, 1),
                                glm::dvec3(0, 0, -1)}) {
    const auto wall = skin.first_hit({0.0, 50.0, 0.0}, out, 200.0);
    ASSERT_TRUE(wall.has_value());
    EXPECT_TRUE(wall->cut) << out.x << " " << out.y << " " << out.z;
  }
}

TEST(GelBlockCase, NothingOfItIsAPatients) {
  EXPECT_EQ(block().origin, "phantom:gel_block:1:out_of_plane");
  EXPECT_TRUE(block().no_burned_in_text);
  ASSERT_TRUE(block().labels.has_value());
  EXPECT_EQ(block().labels->label.size(), block().volume.hu.size());
}

// Steps that are done around a patient are not asked of gel.
// Who waits in view has shown nothing: no shipped rule asks for a share of time. Before: drill 1, "vis_joint >=
// 0.5".
TEST(ShippedRules, AskForNoShareOfTime) {
  for (const std::vector<DemoCase>* all : {&drills(), &demo_cases()})
    for (const DemoCase& one : *all)
      for (const assessment::Criterion& criterion : one.setting.rule.criteria)
        EXPECT_FALSE(criterion.metric.starts_with("vis_")) << one.title << ": " << criterion.metric;
}

TEST(Drills, AskForOneThingAndAHitThroughOneHole) {
  ASSERT_EQ(drills().size(), 3U);
  for (const DemoCase& drill : drills()) {
    SCOPED_TRACE(drill.title);
    EXPECT_EQ(drill.title.rfind("Drill " + std::to_string(drill.number) + ": ", 0), 0U);
    EXPECT_TRUE(casedb::check_setting(drill.setting).has_value());
    EXPECT_EQ(drill.setting.difficulty, casedb::Difficulty::easy);
    ASSERT_TRUE(drill.setting.planned_entry_lps_mm.has_value());
    std::vector<std::string> asked;
    for (const assessment::Criterion& one : drill.setting.rule.criteria) asked.push_back(one.metric);
    const auto asks = [&](const char* id) { return std::find(asked.begin(), asked.end(), id) != asked.end(); };
    EXPECT_TRUE(asks("hit"));
    EXPECT_TRUE(asks("skin_punctures"));
    for (const char* around : {"steps_done", "steps_violated", "pain_reactions", "decision_right",
                               "advance_breath_held_share", "fired_breath_held", "breath_hold_used"})
      EXPECT_FALSE(asks(around)) << around;
    EXPECT_TRUE(asks(drill.number == 1   ? "advance_joint_visible_last_20_mm"
                     : drill.number == 2 ? "advance_visible_share"
                                         : "advance_beyond_plane"));
    // The planned way, from the top to the ball, is one that a hand can hold beside a probe. Along the picture it
    // may be flatter: the flatter, the more of the needle is seen (decision 0106).
    const glm::dvec3 way = drill.lesions.at(0).center_lps_mm - *drill.setting.planned_entry_lps_mm;
    const double steep_deg = std::asin(way.y / glm::length(way)) * 180.0 / std::acos(-1.0);
    EXPECT_GT(steep_deg, drill.setting.approach == cases::Approach::out_of_plane ? 40.0 : 30.0);
    EXPECT_LT(steep_deg, 60.0);
  }
}

}  // namespace
}  // namespace seldinger::app
