#include "app/window/hands/braced_hand.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <glm/geometric.hpp>

#include "tests/fixtures/ball_case.h"

namespace seldinger::app {
namespace {

cases::Case ball(bool breathes) {
  cases::Case scene = fixtures::ball_case();
  scene.classes.assign(scene.volume.hu.size(), volume::TissueClass::liver);
  if (breathes) scene.breathing.emplace();
  return scene;
}

cases::State breathed(double level) {
  cases::State state;
  state.breath.moves = true;
  state.breath.level = level;
  return state;
}

TEST(BracedHand, NothingIsCarriedAtAPatientWhoLiesStill) {
  const cases::Case scene = ball(false);
  BracedHand hand(scene);
  hand.see(breathed(1.0));
  const cases::ToolPose pose{{0.0, -50.0, 0.0}, {0.0, 1.0, 0.0}, {1.0, 0.0, 0.0}};
  EXPECT_EQ(hand.carried(pose, 0.0).position_lps_mm, pose.position_lps_mm);
}

// On the skin it is where the skin is; deeper and above it goes along without a leap, and turns nowhere.
TEST(BracedHand, GoesWithTheSkinBelowIt) {
  const cases::Case scene = ball(true);
  BracedHand hand(scene);
  const engine::MovingTissue tissue(scene);
  const cases::State state = breathed(1.0);
  hand.see(state);
  const glm::dvec3 entry(0.0, -50.0, 0.0), in(0.0, 1.0, 0.0);
  const glm::dvec3 moved = tissue::displaced(tissue.felt_by_probe(state), entry) - entry;
  ASSERT_GT(glm::length(moved), 1.0);
  cases::ToolPose before;
  for (double inserted_mm = -20.0; inserted_mm <= 40.0; inserted_mm += 0.5) {
    const cases::ToolPose pose{entry + inserted_mm * in, in, {1.0, 0.0, 0.0}};
    const cases::ToolPose carried = hand.carried(pose, std::max(0.0, inserted_mm));
    EXPECT_NEAR(glm::length(carried.position_lps_mm - pose.position_lps_mm - moved), 0.0, 0.2) << inserted_mm;
    EXPECT_EQ(carried.axis, pose.axis);
    const double step_mm = glm::length(carried.position_lps_mm - before.position_lps_mm);
    EXPECT_TRUE(inserted_mm == -20.0 || step_mm < 0.7) << inserted_mm << " " << step_mm;
    before = carried;
  }
}

// From where a tool was left to what a hand holds, and back: who goes on with an attempt makes no leap.
TEST(BracedHand, PutsBackWhatItCarried) {
  const cases::Case scene = ball(true);
  BracedHand hand(scene);
  const glm::dvec3 in = glm::normalize(glm::dvec3(0.3, 1.0, 0.2));
  for (const double level : {0.2, 1.0}) {
    hand.see(breathed(level));
    for (double inserted_mm = -20.0; inserted_mm <= 30.0; inserted_mm += 5.0) {
      const cases::ToolPose left{glm::dvec3(8.0, -46.0, 12.0) + inserted_mm * in, in, {1.0, 0.0, 0.0}};
      const double in_body_mm = std::max(0.0, inserted_mm);
      const cases::ToolPose again = hand.carried(hand.put_back(left, in_body_mm), in_body_mm);
      EXPECT_LT(glm::distance(again.position_lps_mm, left.position_lps_mm), 0.01) << level << " " << inserted_mm;
      EXPECT_EQ(again.axis, left.axis);
    }
  }
}

}  // namespace
}  // namespace seldinger::app
