// Tests of sim/devices/hands/gamepad_hands.
#include "sim/devices/hands/gamepad_hands.h"

#include <gtest/gtest.h>

#include <limits>

#include "tests/sim/devices/hands_fixture.h"

namespace seldinger::devices {
namespace {

constexpr double kSecond = 1.0;

HandIntent of(const GamepadReading& pad, HeldTool tool = HeldTool::needle, bool left_handed = false) {
  GamepadHands hands(left_handed);
  return hands.intent(pad, front_view(), tool, above_flat().needle, kSecond);
}

TEST(GamepadHands, AtRestNothingMoves) {
  GamepadReading pad;
  pad.axes = {0.1F, -0.1F, 0.05F, 0.11F, -1.0F, -0.97F};
  const HandIntent intent = of(pad);
  EXPECT_EQ(intent.slide_lps_mm, glm::dvec3(0.0));
  EXPECT_EQ(intent.turn_lps_rad, glm::dvec3(0.0));
  EXPECT_EQ(intent.advance_mm, 0.0);
}

TEST(GamepadHands, AStickGrowsFromItsDeadZoneToOne) {
  EXPECT_EQ(stick_share(kDeadZone), 0.0);
  EXPECT_EQ(stick_share(1.0), 1.0);
  EXPECT_EQ(stick_share(-1.0), -1.0);
  EXPECT_NEAR(stick_share(kDeadZone + 0.5 * (1.0 - kDeadZone)), 0.125, 1e-12);
}

TEST(GamepadHands, FullSticksAndTriggersAreTheStatedSpeeds) {
  GamepadReading pad;
  pad.axes = {1.0F, -1.0F, 0.0F, 0.0F, -1.0F, 1.0F};
  const HandIntent intent = of(pad);
  EXPECT_EQ(intent.slide_lps_mm, glm::dvec3(kStickSlideMmS, 0.0, kStickSlideMmS)) << "stick up is the screen's up";
  EXPECT_EQ(intent.advance_mm, kTriggerMmS);
  pad.axes[4] = 1.0F;
  EXPECT_EQ(of(pad).advance_mm, 0.0) << "both triggers hold each other";
}

TEST(GamepadHands, TheRightStickTurnsAsTheMouseDoes) {
  GamepadReading pad;
  pad.axes[2] = 1.0F;
  MouseHands mouse;
  MouseEvents drag;
  drag.secondary = true;
  drag.right_px = kStickTurnRadS / kRadPerPixel;
  for (const HeldTool tool : {HeldTool::needle, HeldTool::probe}) {
    const HandIntent by_pad = of(pad, tool);
    const HandIntent by_mouse = mouse.intent(drag, front_view(), tool, above_flat().needle);
    EXPECT_LT(glm::length(by_pad.turn_lps_rad - by_mouse.turn_lps_rad), 1e-12);
    EXPECT_LT(glm::length(by_pad.turn_own_rad - by_mouse.turn_own_rad), 1e-12);
    EXPECT_NEAR(glm::length(by_pad.turn_lps_rad) + glm::length(by_pad.turn_own_rad), kStickTurnRadS, 1e-12);
  }
}

TEST(GamepadHands, ALeftHandedOneIsTheOtherWayRound) {
  GamepadReading right, left;
  right.axes = {0.5F, 0.7F, 0.9F, -0.4F, 0.2F, 0.8F};
  left.axes = {0.9F, -0.4F, 0.5F, 0.7F, 0.8F, 0.2F};
  right.buttons[5] = left.buttons[4] = true;  // fine
  const HandIntent a = of(right), b = of(left, HeldTool::needle, true);
  EXPECT_EQ(a.slide_lps_mm, b.slide_lps_mm);
  EXPECT_EQ(a.turn_lps_rad, b.turn_lps_rad);
  EXPECT_EQ(a.advance_mm, b.advance_mm);
  right.buttons[5] = false;
  EXPECT_LT(glm::length(of(right).slide_lps_mm * kFine - a.slide_lps_mm), 1e-12);
}

TEST(GamepadHands, ButtonsActWhenTheyGoDownAndBrokenNumbersDoNot) {
  GamepadHands hands;
  GamepadReading pad;
  pad.buttons[0] = pad.buttons[2] = pad.buttons[7] = true;
  pad.axes = {std::numeric_limits<float>::quiet_NaN(), 1e30F, 0.0F, 0.0F, -1.0F, -1.0F};
  HandIntent intent = hands.intent(pad, front_view(), HeldTool::needle, above_flat().needle, 0.01);
  EXPECT_TRUE(intent.fire);
  EXPECT_EQ(intent.swaps, 1U);
  EXPECT_EQ(intent.resets, 1U);
  EXPECT_EQ(intent.slide_lps_mm, glm::dvec3(0.0, 0.0, -kStickSlideMmS * 0.01)) << "at most full deflection";
  intent = hands.intent(pad, front_view(), HeldTool::needle, above_flat().needle, 0.01);
  EXPECT_EQ(intent.swaps, 0U) << "held, not pressed again";
}

// The whole job with a gamepad: the probe is laid aside, the needle to the entry and 40 mm in.
TEST(GamepadHands, LeadsANeedleIntoTheBody) {
  GamepadHands pad_hands;
  Hands hands(flat_skin(), above_flat());
  const auto hold = [&](const GamepadReading& pad, int frames) {
    for (int i = 0; i < frames; ++i)
      hands.advance(pad_hands.intent(pad, front_view(), hands.held(), hands.held_pose(), kFrameS), {0.5, 0.0},
                    kFrameS);
  };
  GamepadReading right, down, in;
  right.axes[0] = 1.0F;
  down.axes[1] = 1.0F;
  in.axes[5] = 1.0F;
  hold(right, 12);
  hold(down, 60);
  EXPECT_FALSE(hands.needle_inserted());
  EXPECT_NEAR(hands.needle().position_lps_mm.x, 0.2 * kStickSlideMmS, 1e-6);
  hold(in, 92);
  EXPECT_NEAR(hands.inserted_mm(), 40.0, 2.0) << "at two thirds of 40 mm/s against half a newton";
}

}  // namespace
}  // namespace seldinger::devices
