// Tests of sim/devices/hands: what tools do that are led without force feedback.
#include "sim/devices/hands/hands.h"

#include <gtest/gtest.h>

#include <numbers>

#include "sim/base/rng.h"
#include "sim/devices/hands/turning.h"
#include "tests/fixtures/allocations.h"
#include "tests/sim/devices/hands_fixture.h"

namespace seldinger::devices {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

void run(Hands& hands, const HandIntent& each_ms, int ms, const AxialForces& forces = {}) {
  for (int i = 0; i < ms; ++i) hands.advance(each_ms, forces, 0.001);
}

HandIntent advancing(double mm) {
  HandIntent intent;
  intent.advance_mm = mm;
  return intent;
}
HandIntent sliding(const glm::dvec3& mm) {
  HandIntent intent;
  intent.slide_lps_mm = mm;
  return intent;
}
HandIntent turning(const glm::dvec3& rad) {
  HandIntent intent;
  intent.turn_lps_rad = rad;
  return intent;
}
HandIntent swap() {
  HandIntent intent;
  intent.swaps = 1;
  return intent;
}
HandIntent guide() {
  HandIntent intent;
  intent.guides = 1;
  return intent;
}
HandIntent reset() {
  HandIntent intent;
  intent.resets = 1;
  return intent;
}

Hands inserted(double depth_mm) {
  Hands hands(flat_skin(), above_flat());
  run(hands, advancing(0.02), 4000);
  run(hands, advancing((depth_mm - hands.inserted_mm()) / 2000.0), 2000);
  return hands;
}

TEST(Hands, ANeedleIsSetDownOnTheSkinByDraggingAndNotThroughIt) {
  Hands hands(flat_skin(), above_flat());
  run(hands, sliding({0.02, 0.0, -0.05}), 1000);
  run(hands, {}, 300);
  EXPECT_FALSE(hands.needle_inserted());
  EXPECT_GT(hands.needle().position_lps_mm.z, 0.0);
  EXPECT_LE(hands.needle().position_lps_mm.z, kSkinGapMm);
  EXPECT_NEAR(hands.needle().position_lps_mm.x, 20.0, 1e-6) << "along the skin it goes on";
}

TEST(Hands, OnlyAnAdvancePuncturesAndThenTheNeedleKeepsToItsLine) {
  const Hands hands = inserted(40.0);
  EXPECT_TRUE(hands.needle_inserted());
  EXPECT_NEAR(hands.inserted_mm(), 40.0, 1e-6);
  EXPECT_NEAR(hands.needle().position_lps_mm.x, 0.0, 1e-12);
  EXPECT_NEAR(hands.needle().position_lps_mm.z, -40.0, 1e-5);
}

TEST(Hands, LetGoOfTheyForgetWhatWasStillWanted) {
  Hands hands = inserted(15.0);
  hands.advance(advancing(10.0), {}, 0.001);  // follows over the next 0.2 s
  const double depth_mm = hands.inserted_mm();
  hands.let_go();
  run(hands, {}, 300);
  EXPECT_NEAR(hands.inserted_mm(), depth_mm, 1e-9);
}

TEST(Hands, WithoutAProbeTheNeedleStaysInTheHand) {
  HandsSettings settings;
  settings.has_probe = false;
  Hands hands(flat_skin(), above_flat(), settings);
  hands.advance(swap(), {}, 0.001);
  EXPECT_EQ(hands.held(), HeldTool::needle);
}

TEST(Hands, InTissueADragTurnsTheNeedleAboutItsEntry) {
  Hands hands = inserted(15.0);
  const double depth_mm = hands.inserted_mm();
  run(hands, sliding({0.02, 0.01, 0.0}), 500);
  run(hands, {}, 100);
  const cases::ToolPose& needle = hands.needle();
  EXPECT_LT(needle.axis.x, -0.01) << "the hub went right";
  EXPECT_NEAR(hands.inserted_mm(), depth_mm, 1e-9);
  EXPECT_LT(glm::length(needle.position_lps_mm - needle.axis * depth_mm), 1e-6) << "the entry stays where it was";
  // The hub, 185 mm behind the entry, went as far as the hand, along its arc.
  EXPECT_NEAR(std::acos(-needle.axis.z), std::hypot(10.0, 5.0) / (200.0 - depth_mm), 2e-4);
}

TEST(Hands, TheEntryStaysThroughAThousandTurnsAndWays) {
  Hands hands = inserted(30.0);
  for (int i = 0; i < 1000; ++i) {
    HandIntent intent = turning({0.002 * std::sin(0.1 * i), 0.003 * std::cos(0.13 * i), 0.001});
    intent.advance_mm = 0.04 * std::sin(0.05 * i);
    hands.advance(intent, {}, 0.001);
    ASSERT_LT(glm::length(hands.needle().position_lps_mm - hands.needle().axis * hands.inserted_mm()), 1e-6);
  }
}

TEST(Hands, TissueLetsANeedleTurnLessTheDeeperItIs) {
  double last_rad = 1.0;
  for (const double depth_mm : {5.0, 15.0, 30.0, 60.0, 90.0}) {
    Hands hands = inserted(depth_mm);
    run(hands, turning({0.0, 0.003, 0.0}), 1000);
    const double turned_rad = std::acos(-hands.needle().axis.z);
    EXPECT_NEAR(turned_rad, most_pivot_rad(depth_mm), 1e-6) << depth_mm;
    EXPECT_LE(std::sin(turned_rad) * depth_mm, kMostSweepMm + 1e-4);
    EXPECT_LE(turned_rad, last_rad);
    last_rad = turned_rad;
  }
  EXPECT_NEAR(most_pivot_rad(1.0), 20.0 * kDegree, 1e-12);
}

TEST(Hands, ANeedleThatIsWithdrawnMayBeRedirectedAndThenGoesThere) {
  Hands hands = inserted(80.0);
  run(hands, advancing(-0.05), 1400);
  run(hands, {}, 300);
  const double shallow_mm = hands.inserted_mm();
  ASSERT_NEAR(shallow_mm, 10.0, 1e-6);
  run(hands, turning({0.0, 0.003, 0.0}), 300);
  const double redirected_rad = std::acos(-hands.needle().axis.z);
  EXPECT_GT(redirected_rad, 15.0 * kDegree);
  run(hands, advancing(0.05), 1400);
  EXPECT_NEAR(std::acos(-hands.needle().axis.z), redirected_rad, 1e-9)
      << "led along its new line, not brought back";
}

TEST(Hands, WithdrawnIsFreeAgain) {
  Hands hands = inserted(20.0);
  run(hands, advancing(-0.05), 600);
  run(hands, {}, 300);
  EXPECT_FALSE(hands.needle_inserted());
  EXPECT_EQ(hands.inserted_mm(), 0.0);
  const glm::dvec3 before = hands.needle().position_lps_mm;
  run(hands, sliding({0.0, 0.03, 0.03}), 100);
  run(hands, {}, 300);
  EXPECT_LT(glm::length(hands.needle().position_lps_mm - before - glm::dvec3(0, 3, 3)), 1e-9);
}

TEST(Hands, ForceSlowsAnAdvanceEvenlyAndNeverTurnsItRound) {
  double last = 1.1;
  for (double n = -2.0; n < 50.0; n += 0.25) {
    const double share = share_against(n, 1.0, kNeedleHalfN);
    EXPECT_GT(share, 0.0);
    EXPECT_LE(share, std::min(1.0, last));
    last = share;
  }
  EXPECT_EQ(share_against(kNeedleHalfN, 1.0, kNeedleHalfN), 0.5);
  EXPECT_EQ(share_against(5.0, -1.0, kNeedleHalfN), 1.0) << "what pushes out helps the way out";
  EXPECT_EQ(share_against(-1.0, -1.0, kNeedleHalfN), 0.5) << "friction holds the way out";
  EXPECT_EQ(share_against(std::nan(""), 1.0, kNeedleHalfN), 0.0);
  Hands hands = inserted(10.0);
  double deep_mm = hands.inserted_mm();
  for (int i = 0; i < 1000; ++i) {
    hands.advance(advancing(0.01), {static_cast<double>(i % 40), 0.0}, 0.001);
    EXPECT_GE(hands.inserted_mm(), deep_mm);
    deep_mm = hands.inserted_mm();
  }
  Hands light = inserted(10.0), heavy = inserted(10.0);
  run(light, advancing(0.01), 1000, {0.0, 0.0});
  run(heavy, advancing(0.01), 1000, {3.0, 0.0});
  EXPECT_NEAR(light.inserted_mm(), 20.0, 1e-5);
  EXPECT_NEAR(heavy.inserted_mm(), 12.5, 1e-5);
}

TEST(Hands, NothingMovesFasterThanAHand) {
  Hands hands(round_skin(), start_over(round_skin(), {0.0, 0.0, 100.0}, {20.0, 0.0, 50.0}, true, false));
  base::Rng rng(3);
  cases::ToolPose needle = hands.needle(), probe = hands.probe();
  double depth_mm = 0.0;
  for (int i = 0; i < 20000; ++i) {
    HandIntent intent;
    const auto wild = [&] { return rng.uniform() < 0.9 ? 0.0 : 200.0 * (rng.uniform() - 0.5); };
    intent.slide_lps_mm = {wild(), wild(), wild()};
    intent.turn_lps_rad = 0.01 * glm::dvec3(wild(), wild(), wild());
    intent.advance_mm = wild();
    intent.swaps = rng.uniform() < 0.01 ? 1 : 0;
    intent.resets = rng.uniform() < 0.002 ? 1 : 0;
    intent.keep_tilt = i % 500 > 250;
    hands.advance(intent, {}, 0.001);
    const double needle_mm = glm::length(hands.needle().position_lps_mm - needle.position_lps_mm);
    // In tissue it goes at kInsertMmS, and its tip with the turn about the entry.
    ASSERT_LE(needle_mm, 0.001 * (2.0 * kSlideMmS) + 1e-9) << i;
    ASSERT_LE(glm::length(hands.probe().position_lps_mm - probe.position_lps_mm),
              0.001 * (kSlideMmS + kPressMmS + 3.0 * kTurnRadS * 60.0) + 0.11)
        << i;
    if (hands.needle_inserted() && depth_mm > 0.0) {
      ASSERT_LE(std::abs(hands.inserted_mm() - depth_mm), 0.001 * kInsertMmS + 1e-9);
    }
    ASSERT_NEAR(glm::length(hands.needle().axis), 1.0, 1e-9);
    ASSERT_NEAR(glm::dot(hands.probe().axis, hands.probe().side), 0.0, 1e-9);
    depth_mm = hands.inserted_mm();
    needle = hands.needle();
    probe = hands.probe();
  }
}

TEST(Hands, TheProbeFollowsTheSkinAndItsNormal) {
  Hands hands(round_skin(), {{{0, 0, 130}, {0, 0, -1}, {1, 0, 0}}, {{0, 0, 100}, {0, 0, -1}, {1, 0, 0}}});
  hands.advance(swap(), {}, 0.001);
  run(hands, sliding({0.1, 0.0, 0.0}), 500);
  run(hands, {}, 300);
  const cases::ToolPose& probe = hands.probe();
  EXPECT_NEAR(glm::length(probe.position_lps_mm), 100.0, 0.1) << "on the sphere, whose facets are 0.1 mm inside";
  const double angle_rad = std::atan2(probe.position_lps_mm.x, probe.position_lps_mm.z);
  EXPECT_NEAR(angle_rad, 0.47, 0.04) << "50 mm wanted along a curve of 100 mm";
  EXPECT_LT(glm::length(probe.axis + glm::normalize(probe.position_lps_mm)), 0.02) << "facets of 2°, smoothed";
  EXPECT_NEAR(probe.position_lps_mm.y, 0.0, 0.3);
}

TEST(Hands, AProbeThatKeepsItsTiltKeepsIt) {
  Hands hands(round_skin(), {{{0, 0, 130}, {0, 0, -1}, {1, 0, 0}}, {{0, 0, 100}, {0, 0, -1}, {1, 0, 0}}});
  hands.advance(swap(), {}, 0.001);
  HandIntent intent = sliding({0.1, 0.0, 0.0});
  intent.keep_tilt = true;
  run(hands, intent, 300);
  EXPECT_EQ(hands.probe().axis, glm::dvec3(0, 0, -1));
  EXPECT_GT(hands.probe().position_lps_mm.x, 20.0);
}

TEST(Hands, APressGoesAlongTheAxisWithinBoundsAndAgainstForce) {
  Hands hands(flat_skin(), above_flat());
  hands.advance(swap(), {}, 0.001);
  run(hands, advancing(0.01), 500);
  EXPECT_NEAR(hands.press_mm(), 5.0, 1e-9);
  EXPECT_NEAR(hands.probe().position_lps_mm.z, -5.0, 1e-6);
  run(hands, advancing(0.01), 500, {0.0, kProbeHalfN});
  EXPECT_NEAR(hands.press_mm(), 7.5, 1e-9);
  run(hands, advancing(0.05), 3000);
  EXPECT_EQ(hands.press_mm(), kMostPressMm);
  run(hands, advancing(-0.05), 4000);
  EXPECT_EQ(hands.press_mm(), kLeastPressMm) << "lifted off";
}

TEST(Hands, TheProbesGuideKeepsTheNeedleInItsPlane) {
  Hands hands(round_skin(), start_over(round_skin(), {0.0, 0.0, 100.0}, {40.0, 0.0, 60.0}, true, false));
  hands.advance(guide(), {}, 0.001);
  run(hands, {}, 3000);
  ASSERT_TRUE(hands.in_guide());
  const auto expect_in_plane = [&] {
    const cases::ToolPose& probe = hands.probe();
    const glm::dvec3 normal = glm::cross(probe.axis, probe.side);
    ASSERT_NEAR(glm::dot(hands.needle().position_lps_mm - probe.position_lps_mm, normal), 0.0, 1e-9);
    ASSERT_NEAR(glm::dot(hands.needle().axis, normal), 0.0, 1e-9);
    ASSERT_NEAR(glm::dot(hands.needle().axis, probe.axis), std::cos(40.0 * kDegree), 1e-9);
  };
  expect_in_plane();
  hands.advance(swap(), {}, 0.001);
  for (int i = 0; i < 500; ++i) {  // the needle goes with the probe
    HandIntent intent = sliding({0.03, 0.05, 0.0});
    intent.turn_own_rad = {0.0002, -0.0003, 0.0004};
    hands.advance(intent, {}, 0.001);
    expect_in_plane();
    ASSERT_FALSE(hands.needle_inserted()) << "a moved probe does not puncture";
  }
  hands.advance(swap(), {}, 0.001);
  run(hands, advancing(0.05), 3000);
  ASSERT_GT(hands.inserted_mm(), 30.0);
  expect_in_plane();
  hands.advance(swap(), {}, 0.001);
  EXPECT_TRUE(hands.probe_held());
  const glm::dvec3 before = hands.probe().position_lps_mm;
  run(hands, sliding({0.05, 0.05, 0.0}), 200);
  EXPECT_EQ(hands.probe().position_lps_mm, before) << "a needle in tissue holds the guide";
  expect_in_plane();
}

TEST(Hands, ALeftHandsGuideIsTheMirrorImageOfARights) {
  // Seen from the front, the needle left of the probe and right of it.
  HandsStart right = above_flat(), left = right;
  right.needle.position_lps_mm.x = -10.0;
  left.needle.position_lps_mm.x = 10.0;
  right.probe = {{0.0, 0.0, 0.0}, {0.0, 0.0, -1.0}, {1.0, 0.0, 0.0}};
  left.probe = right.probe;
  std::array<Hands, 2> hands{Hands(flat_skin(), right), Hands(flat_skin(), left)};
  for (Hands& each : hands) {
    each.advance(guide(), {}, 0.001);
    run(each, {}, 2000);
    ASSERT_TRUE(each.in_guide());
    run(each, advancing(0.05), 3000);
    ASSERT_TRUE(each.needle_inserted());
    // Its line, as a picture draws it: beside the face, and towards the middle.
    const auto guide = each.guide_on_probe();
    ASSERT_TRUE(guide.has_value());
    const double side_mm = each.needle().position_lps_mm.x, depth_mm = -each.needle().position_lps_mm.z;
    EXPECT_NEAR(guide->offset_mm - std::copysign(std::tan(guide->angle_deg * kDegree) * depth_mm, guide->offset_mm),
                side_mm, 1e-9);
  }
  const cases::ToolPose &a = hands[0].needle(), &b = hands[1].needle();
  EXPECT_NEAR(a.position_lps_mm.x, -b.position_lps_mm.x, 1e-9);
  EXPECT_NEAR(a.position_lps_mm.z, b.position_lps_mm.z, 1e-9);
  EXPECT_NEAR(a.axis.x, std::sin(40.0 * kDegree), 1e-9) << "under the probe, from its left";
  EXPECT_NEAR(b.axis.x, -a.axis.x, 1e-9);
}

TEST(Hands, WithoutAGuideTheNeedleStaysAndThatItWasAskedForIsKnown) {
  HandsSettings settings;
  settings.has_guide = false;
  Hands hands(flat_skin(), above_flat(), settings);
  const glm::dvec3 before = hands.needle().position_lps_mm;
  hands.advance(guide(), {}, 0.001);
  run(hands, {}, 1000);
  EXPECT_FALSE(hands.guided());
  EXPECT_FALSE(hands.guide_on_probe().has_value());
  EXPECT_EQ(hands.needle().position_lps_mm, before);
  EXPECT_EQ(hands.guides_asked(), 1U);
}

TEST(Hands, AGuideInSpaceLeadsToWhatIsAimedAt) {
  Hands hands(flat_skin(), above_flat());
  const LineGuide line{{20.0, 10.0, 0.0}, {50.0, 20.0, -60.0}};
  hands.set_guide(line);
  hands.advance(guide(), {}, 0.001);
  run(hands, {}, 2000);
  ASSERT_TRUE(hands.in_guide());
  run(hands, advancing(0.06), 4000);
  const glm::dvec3 along = glm::normalize(line.aim_lps_mm - line.entry_lps_mm);
  const glm::dvec3 off = hands.needle().position_lps_mm - line.entry_lps_mm;
  EXPECT_GT(hands.inserted_mm(), 40.0);
  EXPECT_LT(glm::length(off - along * glm::dot(off, along)), 1e-6);
  run(hands, sliding({0.1, 0.1, 0.0}), 300);
  EXPECT_LT(glm::length(hands.needle().axis - along), 1e-12) << "a guide does not turn";
  hands.advance(guide(), {}, 0.001);  // let go in tissue: by hand again, from where it is
  EXPECT_FALSE(hands.guided());
  hands.advance(guide(), {}, 0.001);
  EXPECT_FALSE(hands.guided()) << "not taken up again in tissue";
}

TEST(Hands, AResetGoesBackTheWayANeedleCameAndRoundTheBody) {
  const HandsStart start = start_over(round_skin(), {0.0, 0.0, 100.0}, {20.0, 0.0, 50.0}, true, false);
  Hands hands(round_skin(), start);
  // Punctured from the other side of the body.
  HandsStart far = start;
  far.needle = {{30.0, 20.0, -95.0}, glm::normalize(glm::dvec3(-30, -20, 95)), {1, 0, 0}};
  far.needle.position_lps_mm += far.needle.axis * 20.0;
  far.probe = {{70.0, 70.0, 0.0}, glm::normalize(glm::dvec3(-1, -1, 0)), {0, 0, 1}};
  hands.take_over(far);
  ASSERT_TRUE(hands.needle_inserted());
  hands.advance(reset(), {}, 0.001);
  glm::dvec3 last = hands.needle().position_lps_mm;
  bool out = false;
  for (int i = 0; i < 10000 && hands.returning(); ++i) {
    hands.advance({}, {}, 0.001);
    const glm::dvec3& tip = hands.needle().position_lps_mm;
    ASSERT_LE(glm::length(tip - last), 2.0 * kSlideMmS * 0.001 + 1e-9);
    out = out || !hands.needle_inserted();
    ASSERT_FALSE(out && round_skin().closest(tip).distance_mm < -1e-6) << "through the body";
    last = tip;
  }
  EXPECT_FALSE(hands.returning());
  EXPECT_LT(glm::length(hands.needle().position_lps_mm - start.needle.position_lps_mm), 1e-9);
  EXPECT_LT(glm::length(hands.needle().axis - start.needle.axis), 1e-9);
  EXPECT_LT(glm::length(hands.probe().axis - start.probe.axis), 1e-6);
  EXPECT_LT(glm::length(hands.probe().position_lps_mm - start.probe.position_lps_mm), 0.2);
}

TEST(Hands, AStartHoldsEntryAndTargetInTheProbesPlane) {
  for (const bool mirrored : {false, true})
    for (const glm::dvec3& target : {glm::dvec3(30.0, 10.0, 50.0), glm::dvec3(0.0, 0.0, 40.0)}) {
      const glm::dvec3 entry(0.0, 0.0, 100.0);
      const HandsStart in = start_over(round_skin(), entry, target, true, mirrored);
      const glm::dvec3 normal = glm::cross(in.probe.axis, in.probe.side);
      EXPECT_NEAR(glm::dot(entry - in.probe.position_lps_mm, normal), 0.0, 1e-6);
      EXPECT_NEAR(glm::dot(target - in.probe.position_lps_mm, normal), 0.0, 1e-6);
      EXPECT_NEAR(glm::length(in.probe.position_lps_mm), 100.0, 0.2) << "on the skin";
      const glm::dvec3 missed = glm::cross(target - in.needle.position_lps_mm, in.needle.axis);
      EXPECT_LT(glm::length(missed), 1e-9) << "straight on it hits";
      EXPECT_NEAR(round_skin().closest_skin(in.needle.position_lps_mm).distance_mm, 13.5, 1.6);
      const HandsStart across = start_over(round_skin(), entry, target, false, mirrored);
      const glm::dvec3 plane = glm::cross(across.probe.axis, across.probe.side);
      EXPECT_NEAR(glm::dot(target - across.probe.position_lps_mm, plane), 0.0, 1e-6);
      EXPECT_LT(std::abs(glm::dot(across.probe.side, across.needle.axis)), 1e-6) << "the way crosses the plane";
    }
  const HandsStart right = start_over(round_skin(), {0, 0, 100}, {30, 10, 50}, true, false);
  const HandsStart left = start_over(round_skin(), {0, 0, 100}, {30, 10, 50}, true, true);
  EXPECT_LT(glm::length(right.probe.side + left.probe.side), 1e-9);
  EXPECT_GT(glm::dot(right.probe.side, right.probe.position_lps_mm - right.needle.position_lps_mm), 0.0);
}

TEST(Hands, NoNumbersMoveNothing) {
  Hands hands(flat_skin(), above_flat());
  run(hands, sliding({std::nan(""), 0.0, 0.0}), 10);
  HandIntent intent = advancing(1.0);
  hands.advance(intent, {}, 0.0);
  hands.advance(intent, {}, std::nan(""));
  EXPECT_EQ(hands.needle().position_lps_mm, above_flat().needle.position_lps_mm);
}

TEST(Hands, ATickAllocatesNothing) {
  Hands hands(round_skin(), start_over(round_skin(), {0.0, 0.0, 100.0}, {40.0, 0.0, 60.0}, true, false));
  HandIntent intent = sliding({0.1, 0.1, 0.0});
  intent.advance_mm = 0.1;
  const auto before = fixtures::allocations();
  run(hands, intent, 100);
  hands.advance(swap(), {}, 0.001);
  run(hands, intent, 100);
  hands.advance(guide(), {}, 0.001);
  run(hands, {}, 100);
  hands.advance(reset(), {}, 0.001);
  run(hands, {}, 100);
  EXPECT_EQ(fixtures::allocations(), before);
}

}  // namespace
}  // namespace seldinger::devices
