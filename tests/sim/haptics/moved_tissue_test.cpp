// What two hands do to the tissue, as touch leaves it for sim/tissue: pictures then show what the hand feels.
#include <gtest/gtest.h>

#include <array>
#include <glm/geometric.hpp>
#include <optional>

#include "sim/tissue/displacement.h"
#include "tests/sim/haptics/bodies.h"

namespace seldinger::haptics {
namespace {

// Left: the probe; right: the needle.
struct Hands {
  Hands() : hands(flat_body(), two_omnis()) {}
  void rest(const HandInput& left, const HandInput& right, int ticks) {
    for (int i = 0; i < ticks; ++i) force = hands.advance({left, right}, 0.001, states);
  }
  tissue::Displacement displacement() const {
    return tissue::displacement_of({.presses = {&states[0].probe.press, 1}, .needle = states[1].needle.drag});
  }

  TwoHands hands;
  HandStates states{};
  HandForces force{};
};

TEST(MovedTissue, TheSkinLiesUnderTheProbesHead) {
  Hands hands;
  hands.rest(holding(Tool::probe, {0.0, 0.0, 3.0}), {}, 50);
  EXPECT_EQ(tissue::count_sources(hands.displacement()), 0) << "not touched";
  hands.rest(holding(Tool::probe, {0.0, 0.0, -6.0}), {}, 500);
  const tissue::Displacement pressed = hands.displacement();
  ASSERT_EQ(tissue::count_sources(pressed), 1);
  EXPECT_NEAR(tissue::displaced(pressed, glm::dvec3(0.0)).z, -6.0, 0.01);
  // Bone at 90 mm does not move, nor does the skin far away by much.
  EXPECT_LT(glm::distance(tissue::displaced(pressed, {0.0, 0.0, -91.0}), {0.0, 0.0, -91.0}), 1e-9);
  EXPECT_LT(glm::distance(tissue::displaced(pressed, {55.0, 0.0, 0.0}), {55.0, 0.0, 0.0}), 1.2);
  // Over the rib, 6 mm deep, what lies behind it stays.
  hands.rest(holding(Tool::probe, {40.0, 0.0, 3.0}), {}, 50);
  hands.rest(holding(Tool::probe, {40.0, 0.0, -2.0}), {}, 500);
  EXPECT_LT(glm::distance(tissue::displaced(hands.displacement(), {40.0, 0.0, -8.0}), {40.0, 0.0, -8.0}), 1e-9);
  EXPECT_NEAR(tissue::displaced(hands.displacement(), {40.0, 0.0, 0.0}).z, -2.0, 0.01);
  hands.rest(holding(Tool::probe, {40.0, 0.0, 3.0}), {}, 50);
  EXPECT_EQ(tissue::count_sources(hands.displacement()), 0) << "and is let go";
}

TEST(MovedTissue, TheTissueAtTheTipIsAtTheTip) {
  Hands hands;
  double most_mm = 0.0, least_mm = 0.0;
  for (int i = 0; i <= 6000; ++i) {
    // 45 mm in, and out again.
    const double depth_mm = i <= 3000 ? -5.0 + 50.0 * i / 3000.0 : -5.0 + 50.0 * (6000 - i) / 3000.0;
    const glm::dvec3 tip(-10.0, 5.0, -depth_mm);
    hands.rest({}, holding(Tool::needle, tip), 1);
    const tissue::NeedleDrag& drag = hands.states[1].needle.drag;
    const tissue::Displacement displacement = hands.displacement();
    if (drag.tip_mm > 0.01) {
      const glm::dvec3 at_tip = drag.entry_lps_mm + drag.cut_mm * drag.direction;
      ASSERT_NEAR(glm::distance(tissue::displaced(displacement, at_tip), tip), 0.0, 1e-3) << depth_mm;
    }
    most_mm = std::max(most_mm, drag.shaft_mm);
    least_mm = std::min(least_mm, drag.shaft_mm);
  }
  EXPECT_GT(most_mm, 0.5) << "it drags inwards,";
  EXPECT_LT(least_mm, -0.5) << "and outwards on the way back";
  EXPECT_EQ(tissue::count_sources(hands.displacement()), 0) << "outside nothing moves";
}

// The rib, 6 mm deep: the needle stands on it and is pushed on, but bone stays where it is.
TEST(MovedTissue, BoneBeforeTheTipDoesNotMove) {
  Hands hands;
  double most_mm = 0.0;
  for (int i = 0; i <= 1500; ++i) {
    hands.rest({}, holding(Tool::needle, {40.0, 0.0, 3.0 - 0.01 * i}), 1);
    const tissue::NeedleDrag& drag = hands.states[1].needle.drag;
    most_mm = std::max(most_mm, drag.cut_mm + drag.tip_mm);
  }
  EXPECT_GT(most_mm, 4.0) << "up to the bone tissue gives way,";
  EXPECT_LT(most_mm, 7.1) << "within a voxel of where bone begins; the device is 12 mm deep";
}

// A puncture is seen when it is felt: in the tick of the rupture what lay before the tip goes back.
TEST(MovedTissue, SnapsBackInTheTickOfTheRupture) {
  Hands hands;
  double last_mm = 0.0;
  int ruptures = 0;
  for (int i = 0; i <= 4000; ++i) {
    const double depth_mm = -2.0 + 0.015 * i;
    hands.rest({}, holding(Tool::needle, {-10.0, 5.0, -depth_mm}), 1);
    const double pushed_mm = hands.states[1].needle.drag.tip_mm;
    if (hands.force[1].ruptured) {
      ++ruptures;
      EXPECT_LT(pushed_mm, last_mm - 0.5) << depth_mm;
    }
    last_mm = pushed_mm;
  }
  EXPECT_GE(ruptures, 3);
}

}  // namespace
}  // namespace seldinger::haptics
