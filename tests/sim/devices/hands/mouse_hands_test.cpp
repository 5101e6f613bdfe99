// Tests of sim/devices/hands/mouse_hands: what a mouse says, and a puncture with nothing but a mouse.
#include "sim/devices/hands/mouse_hands.h"

#include <gtest/gtest.h>

#include <numbers>

#include "sim/devices/hands/turning.h"
#include "tests/sim/devices/hands_fixture.h"

namespace seldinger::devices {
namespace {

HeldActions with(HandAction action) {
  HeldActions actions;
  actions.set(static_cast<std::size_t>(action));
  return actions;
}

TEST(MouseHands, ADragMovesTheNeedleByPixelsInTheScreensPlane) {
  Desk desk(flat_skin(), above_flat());
  const cases::ToolPose before = desk.hands.needle();
  desk.drag(40.0, -20.0);
  const glm::dvec3 moved = desk.hands.needle().position_lps_mm - before.position_lps_mm;
  EXPECT_NEAR(moved.x, 20.0, 1e-9);
  EXPECT_NEAR(moved.y, 0.0, 1e-9);
  EXPECT_NEAR(moved.z, 10.0, 1e-9);
  EXPECT_EQ(desk.hands.needle().axis, before.axis);
  desk.view = top_view();
  desk.drag(-6.0, 8.0);
  EXPECT_NEAR(glm::length(desk.hands.needle().position_lps_mm - (before.position_lps_mm + moved)), 5.0, 1e-9);
  EXPECT_NEAR(desk.hands.needle().position_lps_mm.y, -4.0, 1e-9);
}

TEST(MouseHands, WithoutAButtonAMouseMovesNothing) {
  Desk desk(flat_skin(), above_flat());
  MouseEvents events;
  events.right_px = 100.0;
  desk.frame(events);
  desk.rest();
  EXPECT_EQ(desk.hands.needle().position_lps_mm, above_flat().needle.position_lps_mm);
}

TEST(MouseHands, FineIsATenth) {
  Desk desk(flat_skin(), above_flat());
  desk.drag(40.0, 0.0, &MouseEvents::primary, with(HandAction::fine));
  EXPECT_NEAR(desk.hands.needle().position_lps_mm.x, 2.0, 1e-9);
}

TEST(MouseHands, DraggingTheHubTurnsTheNeedleAboutItsTip) {
  Desk desk(flat_skin(), above_flat());
  desk.drag(120.0, 0.0, &MouseEvents::secondary);  // 30°
  const cases::ToolPose& needle = desk.hands.needle();
  EXPECT_LT(glm::length(needle.position_lps_mm - above_flat().needle.position_lps_mm), 1e-12);
  // A straight drag of s while the hub turns away: dθ = cos θ ds, so θ is the Gudermannian of s.
  EXPECT_NEAR(std::acos(-needle.axis.z), 2.0 * std::atan(std::tanh(15.0 * std::numbers::pi / 180.0)), 1e-3);
  EXPECT_LT(needle.axis.x, 0.0) << "the hub went right, so the tip points left";
  EXPECT_NEAR(needle.axis.y, 0.0, 1e-12);
}

TEST(MouseHands, TheProbeTiltsRocksAndRotatesByItsOwnAxes) {
  Desk desk(flat_skin(), above_flat());
  desk.press(HandAction::swap);
  desk.drag(0.0, 40.0, &MouseEvents::secondary);  // tilt by 10° about its side
  const double tilt = 10.0 * std::numbers::pi / 180.0;
  EXPECT_LT(glm::length(desk.hands.probe().axis - turned({0, 0, -1}, glm::dvec3(tilt, 0, 0))), 1e-9);
  EXPECT_LT(glm::length(desk.hands.probe().side - glm::dvec3(1, 0, 0)), 1e-9);
  desk.drag(0.0, -40.0, &MouseEvents::secondary);
  desk.drag(40.0, 0.0, &MouseEvents::secondary);  // rock, about axis × side = −y
  EXPECT_LT(glm::length(desk.hands.probe().axis - turned({0, 0, -1}, glm::dvec3(0, -tilt, 0))), 1e-9);
  desk.drag(-40.0, 0.0, &MouseEvents::secondary);
  desk.drag(40.0, 0.0, &MouseEvents::middle);  // about the axis
  EXPECT_LT(glm::length(desk.hands.probe().axis - glm::dvec3(0, 0, -1)), 1e-9);
  EXPECT_LT(glm::length(desk.hands.probe().side - turned({1, 0, 0}, glm::dvec3(0, 0, -tilt))), 1e-9);
  EXPECT_LT(glm::length(desk.hands.probe().position_lps_mm - above_flat().probe.position_lps_mm), 1e-9)
      << "about its face's place";
}

TEST(MouseHands, AWheelThatIsSpunGoesFurtherPerNotch) {
  EXPECT_EQ(notch_mm(0.0), kSlowNotchMm);
  EXPECT_EQ(notch_mm(1e6), kFastNotchMm);
  double last = 0.0;
  for (double rate = 0.0; rate < 40.0; rate += 0.5) {
    EXPECT_GE(notch_mm(rate), last);
    last = notch_mm(rate);
  }
  MouseHands slow, fast;
  MouseEvents events;
  events.elapsed_s = 0.25;
  events.wheel_notches = 1.0;
  double slow_mm = 0.0, fast_mm = 0.0;
  for (int i = 0; i < 20; ++i) slow_mm += slow.intent(events, {}, HeldTool::needle, {}).advance_mm;
  events.elapsed_s = 0.02;
  for (int i = 0; i < 20; ++i) fast_mm += fast.intent(events, {}, HeldTool::needle, {}).advance_mm;
  EXPECT_NEAR(slow_mm, 20.0 * kSlowNotchMm, 1e-12);
  EXPECT_GT(fast_mm, 3.0 * slow_mm);
}

// Was: four notches that came during a frame of half a second counted as spun, went 16 mm on, and punctured.
TEST(MouseHands, AWindowThatLagsMakesNoWheelFast) {
  for (const double frame_s : {0.05, 0.125, 0.25, 0.5, 1.0}) {
    MouseHands mouse;
    MouseEvents events;
    events.elapsed_s = frame_s;
    events.wheel_notches = 8.0 * frame_s;  // eight a second, which is slow
    double way_mm = 0.0;
    for (double t_s = 0.0; t_s < 1.999; t_s += frame_s)
      way_mm += mouse.intent(events, {}, HeldTool::needle, {}).advance_mm;
    EXPECT_NEAR(way_mm, 16.0 * kSlowNotchMm, 1e-9) << "in frames of " << frame_s << " s";
  }
}

TEST(MouseHands, ALeftHandedMouseHasItsButtonsTheOtherWayRound) {
  Desk right(flat_skin(), above_flat()), left(flat_skin(), above_flat(), {}, true);
  right.drag(30.0, 0.0, &MouseEvents::primary);
  right.drag(0.0, 30.0, &MouseEvents::secondary);
  left.drag(30.0, 0.0, &MouseEvents::secondary);
  left.drag(0.0, 30.0, &MouseEvents::primary);
  EXPECT_EQ(right.hands.needle().position_lps_mm, left.hands.needle().position_lps_mm);
  EXPECT_EQ(right.hands.needle().axis, left.hands.needle().axis);
}

TEST(MouseHands, KeysDoWhatTheMouseDoes) {
  Desk desk(flat_skin(), above_flat());
  MouseEvents events;
  events.actions = with(HandAction::slide_right) | with(HandAction::slide_up) | with(HandAction::rotate_more);
  for (int i = 0; i < 60; ++i) desk.frame(events);
  desk.rest();
  const cases::ToolPose& needle = desk.hands.needle();
  EXPECT_NEAR(needle.position_lps_mm.x, kKeySlideMmS, 1e-9);
  EXPECT_NEAR(needle.position_lps_mm.z, 15.0 + kKeySlideMmS, 1e-9);
  EXPECT_NEAR(needle.side.x, std::cos(kKeyTurnRadS), 1e-9);
  const auto opposite = with(HandAction::advance) | with(HandAction::withdraw);
  const glm::dvec3 before = needle.position_lps_mm;
  events.actions = opposite;
  desk.frame(events);
  EXPECT_EQ(desk.hands.needle().position_lps_mm, before);
}

TEST(MouseHands, AButtonThatIsHeldActsOnceAndTheTriggerAsLongAsItIsDown) {
  Desk desk(flat_skin(), above_flat());
  MouseEvents events;
  events.actions = with(HandAction::freeze) | with(HandAction::fire) | with(HandAction::swap);
  for (int i = 0; i < 5; ++i) desk.frame(events);
  EXPECT_TRUE(desk.hands.frozen());
  EXPECT_TRUE(desk.hands.fire());
  EXPECT_EQ(desk.hands.held(), HeldTool::probe);
  desk.frame({});
  EXPECT_FALSE(desk.hands.fire());
  EXPECT_TRUE(desk.hands.frozen());
  cases::Inputs inputs;
  desk.hands.say(inputs);
  EXPECT_TRUE(inputs.freeze);
  EXPECT_EQ(inputs.probe.position_lps_mm, desk.hands.probe().position_lps_mm);
}

TEST(MouseHands, SumsOfIntentsLoseNothingBetweenTwoThreads) {
  MouseHands mouse;
  HandIntent sum, read;
  double slid_mm = 0.0;
  std::uint32_t swaps = 0;
  for (int i = 0; i < 100; ++i) {
    MouseEvents events;
    events.primary = true;
    events.right_px = 3.0;
    events.elapsed_s = kFrameS;
    if (i % 10 == 0) events.actions = with(HandAction::swap);
    add(mouse.intent(events, front_view(), HeldTool::needle, {}), sum);
    if (i % 7 == 6 || i == 99) {  // the reader looks more seldom
      const HandIntent news = since(read, sum);
      slid_mm += news.slide_lps_mm.x;
      swaps += news.swaps;
      read = sum;
    }
  }
  EXPECT_NEAR(slid_mm, 150.0, 1e-9);
  EXPECT_EQ(swaps, 10U);
}

// The whole job with a mouse: probe where the target is, needle to the entry, aimed, in, fired; in a round body
// with a lesion of 6 mm, 45 mm deep.
TEST(MouseHands, TheWholeJobFromTheStartIntoTheLesion) {
  const glm::dvec3 lesion(10.0, 5.0, 55.0);
  const glm::dvec3 entry = round_skin().closest_skin({-18.0, 5.0, 98.0}).point_lps_mm;
  // Not started where it would be enough to push: 12 mm aside, and turned away.
  HandsStart start = start_over(round_skin(), entry, lesion, true, false);
  start.needle.position_lps_mm += glm::dvec3(-6.0, 10.0, 4.0);
  turn({0.1, -0.2, 0.0}, start.needle);
  Desk desk(round_skin(), start);
  cases::SkinPassage passage = cases::start_passage(round_skin(), desk.hands.needle().position_lps_mm, {});
  glm::dvec3 last = desk.hands.needle().position_lps_mm;
  double furthest_mm = 0.0;
  const auto look = [&] {
    furthest_mm = std::max(furthest_mm, glm::length(desk.hands.needle().position_lps_mm - last));
    last = desk.hands.needle().position_lps_mm;
    cases::advance_passage(round_skin(), last, passage);
  };
  // As a person does: drags by what is seen to be missing.
  const auto drag_to = [&](const glm::dvec3& goal) {
    const glm::dvec3 missing = goal - desk.hands.needle().position_lps_mm;
    desk.drag(glm::dot(missing, desk.view.right) / desk.view.mm_per_pixel,
              -glm::dot(missing, desk.view.up) / desk.view.mm_per_pixel);
    look();
  };
  last = desk.hands.needle().position_lps_mm;
  const glm::dvec3 outwards = glm::normalize(entry);
  for (int round = 0; round < 4; ++round) {
    desk.view = front_view();
    drag_to(entry + outwards * 1.0);
    desk.view = top_view();
    drag_to(entry + outwards * 1.0);
  }
  EXPECT_LT(glm::length(desk.hands.needle().position_lps_mm - entry), 1.5);
  for (int round = 0; round < 30; ++round) {  // aimed by the hub, on two views
    desk.view = round % 2 == 0 ? front_view() : top_view();
    const glm::dvec3 aim = glm::normalize(lesion - desk.hands.needle().position_lps_mm);
    const glm::dvec3 hub = desk.hands.needle().axis - aim;  // how the hub has to go, in radians
    desk.drag(glm::dot(hub, desk.view.right) / kRadPerPixel, -glm::dot(hub, desk.view.up) / kRadPerPixel,
              &MouseEvents::secondary);
    look();
  }
  EXPECT_FALSE(passage.in_body);
  furthest_mm = 0.0;
  for (int notch = 0; notch < 400 && glm::length(desk.hands.needle().position_lps_mm - lesion) > 1.0; ++notch) {
    desk.wheel(1, 1.5);
    look();
  }
  desk.press(HandAction::fire);
  EXPECT_LT(glm::length(desk.hands.needle().position_lps_mm - lesion), 3.0) << "of a radius of 6 mm";
  EXPECT_TRUE(passage.in_body);
  EXPECT_TRUE(desk.hands.needle_inserted());
  EXPECT_NEAR(desk.hands.inserted_mm(), glm::length(desk.hands.needle().position_lps_mm - passage.entry_lps_mm),
              1e-6)
      << "as step() will see it";
  EXPECT_LT(furthest_mm, 1.0) << "a notch in tissue is a small step";
}

}  // namespace
}  // namespace seldinger::devices
