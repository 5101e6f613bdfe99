// Tests of sim/haptics/two_hands, held_needle and held_probe: tools in space against the laws along one line, and
// what happens when something else happens: swaps, faults, delays (S12, S14-S17 of docs/touch.md).
#include "sim/haptics/two_hands.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <glm/geometric.hpp>
#include <limits>
#include <vector>

#include "tests/fixtures/allocations.h"
#include "tests/sim/haptics/bodies.h"

namespace seldinger::haptics {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kMostStepN = 0.15;  // docs/touch.md
constexpr double kRounding = 1e-12;

// The right hand at work, the left holding nothing.
struct Right {
  explicit Right(const cases::Case& scene, std::array<HandSettings, 2> settings = two_omnis())
      : hands(scene, settings) {}

  HandForce tick(const HandInput& input, double elapsed_s = kTickS) {
    const glm::dvec3 last_n = force.motor_n;
    force = hands.advance({HandInput{}, input}, elapsed_s, states)[1];
    step_n = glm::distance(force.motor_n, last_n);
    most_step_n = std::max(most_step_n, step_n);
    return force;
  }
  // Straight from where it is, `ticks` long.
  void move(HandInput input, const glm::dvec3& to_lps_mm, int ticks) {
    const glm::dvec3 from = input.pose.position_lps_mm;
    for (int i = 1; i <= ticks; ++i) {
      input.pose.position_lps_mm = from + (to_lps_mm - from) * (static_cast<double>(i) / ticks);
      tick(input);
      peak_n = std::max(peak_n, -glm::dot(force.motor_n, input.pose.axis));
    }
  }
  void rest(const HandInput& input, int ticks) {
    for (int i = 0; i < ticks; ++i) tick(input);
  }

  TwoHands hands;
  HandStates states{};
  HandForce force;
  double step_n = 0.0, most_step_n = 0.0, peak_n = 0.0;
};

// In space, straight down and obliquely, it is the law along its line: the path in pieces is the whole path.
TEST(TwoHands, ANeedleInSpaceIsTheLawAlongItsLine) {
  for (const double tilt : {0.0, 0.5}) {
    const cases::Case& scene = flat_body();
    const glm::dvec3 axis = glm::normalize(glm::dvec3(-tilt, 0.0, -1.0)), entry(10.0, 5.0, 0.0);
    const TissueAlongNeedle tissue(scene.volume, scene.classes, *cases::gauge(kTableGauge));
    NeedlePath path;
    tissue.look(entry, axis, 140.0, -5.0, {}, path);
    const NeedleLaw law(needle_settings(*find_arm_model("omni")));
    NeedleTrack track;
    Right right(scene);
    int ruptures = 0;
    for (int i = 0; i < 2600; ++i) {
      const double depth_mm = -10.0 + 0.03 * i;
      const glm::dvec3 wanted_n =
          right.tick(holding(Tool::needle, entry + depth_mm * axis, (1.0 + tilt) * axis)).wanted_n;
      const NeedleForce along = law.advance(path.span(), depth_mm, track);
      ASSERT_NEAR(glm::distance(wanted_n, -along.axial_n * axis), 0.0, 1e-6) << depth_mm;
      EXPECT_EQ(right.force.ruptured, along.ruptured);
      ruptures += along.ruptured ? 1 : 0;
    }
    EXPECT_EQ(ruptures, 4) << "skin, fat, muscle, kidney";
    EXPECT_LE(right.most_step_n, kMostStepN + kRounding);
  }
}

TEST(TwoHands, AHoleStaysAHole) {
  Right right(flat_body());
  const auto through = [&](double x_mm) {
    right.peak_n = 0.0;
    right.move(holding(Tool::needle, {x_mm, 0.0, 10.0}), {x_mm, 0.0, -25.0}, 1500);
    const double peak_n = right.peak_n;
    right.move(holding(Tool::needle, {x_mm, 0.0, -25.0}), {x_mm, 0.0, -20.0}, 500);
    EXPECT_LT(-glm::dot(right.force.wanted_n, kDown), 0.0) << "friction holds back what is pulled";
    right.move(holding(Tool::needle, {x_mm, 0.0, -20.0}), {x_mm, 0.0, 10.0}, 1500);
    EXPECT_EQ(right.force.wanted_n, glm::dvec3(0.0)) << "outside is outside";
    return peak_n;
  };
  const double first_n = through(0.0), again_n = through(0.5), beside_n = through(-10.0);
  EXPECT_GT(first_n, 2.4) << "the skin's rupture";
  EXPECT_LT(again_n, 0.5 * first_n) << "no second one";
  EXPECT_NEAR(beside_n, first_n, 0.02) << "beside it, there is";
  EXPECT_LE(right.most_step_n, kMostStepN + kRounding);
}

// Within it the skin lets go at once, beside it as before; what lies below is as it was.
TEST(TwoHands, ANeedleDropsIntoANick) {
  const std::array<glm::dvec3, 2> nicks = {glm::dvec3{0.0, 0.0, 0.0}, {-30.0, 0.0, 0.0}};
  const auto into = [&](double x_mm, std::span<const glm::dvec3> nicked, double to_mm) {
    Right right(flat_body());
    HandInput input = holding(Tool::needle, {x_mm, 0.0, 10.0});
    input.nicks_lps_mm = nicked;
    right.move(input, {x_mm, 0.0, -to_mm}, 3000);
    EXPECT_LE(right.most_step_n, kMostStepN + kRounding);
    EXPECT_EQ(right.states[1].needle.track.opened > 0, true);
    return right.peak_n;
  };
  const double whole_n = into(0.0, {}, 12.0);
  EXPECT_GT(whole_n, 2.4) << "the skin's rupture";
  for (const double x_mm : {0.0, 1.5, -30.0, -28.5})
    EXPECT_LT(into(x_mm, nicks, 12.0), 0.5) << x_mm << ": fat's rupture alone is left";
  EXPECT_NEAR(into(-10.0, nicks, 12.0), whole_n, 0.02) << "beside them";
  const double edge_n = into(3.0, nicks, 12.0);
  EXPECT_GT(edge_n, 0.3 * whole_n);
  EXPECT_LT(edge_n, 0.7 * whole_n);
  // Pressed in beside and drawn over it: it falls in, and no tick is a step.
  Right right(flat_body());
  HandInput input = holding(Tool::needle, {-10.0, 0.0, 5.0});
  input.nicks_lps_mm = nicks;
  right.move(input, {-10.0, 0.0, -6.0}, 1000);
  ASSERT_EQ(right.states[1].needle.track.opened, 0U);
  input.pose.position_lps_mm = {-10.0, 0.0, -6.0};
  right.move(input, {0.0, 0.0, -6.0}, 500);
  EXPECT_GT(right.states[1].needle.track.opened, 0U);
  EXPECT_LE(right.most_step_n, kMostStepN + kRounding);
}

// The introducer is wider than the needle and pushed on as such; once its stylet is drawn it stays, and the needle
// slides in it, out and in again, from where tissue is cut on; no tick is a step.
TEST(TwoHands, AnIntroducerStaysAndTheNeedleSlidesInIt) {
  cases::Case scene = flat_body();
  scene.touch = {cases::NeedleTip::core, cases::TouchLaw::by_speed};
  const auto pushed_in = [&](Introducer introducer) {
    Right right(scene);
    HandInput input = holding(Tool::needle, {0.0, 0.0, 10.0});
    input.introducer = introducer;
    right.move(input, {0.0, 0.0, -55.0}, 4000);
    return right;
  };
  Right bare = pushed_in(Introducer::none), right = pushed_in(Introducer::closed);
  EXPECT_GT(right.peak_n, 1.2 * bare.peak_n) << "0.2 mm wider, and a trocar's point";
  const double held_n = -glm::dot(right.force.wanted_n, kDown);
  EXPECT_GT(held_n, 1.2 * -glm::dot(bare.force.wanted_n, kDown));

  HandInput input = holding(Tool::needle, {0.0, 0.0, -55.0});
  input.introducer = Introducer::open;
  right.rest(input, 300);
  const double bare_tip_n = bare.states[1].needle.path.layers[3].tissue.intercept_n;
  EXPECT_LT(-glm::dot(right.force.wanted_n, kDown), held_n) << "friction is the tube's to bear";
  EXPECT_GT(-glm::dot(right.force.wanted_n, kDown), 0.3 * bare_tip_n) << "before the tip there is tissue";
  right.peak_n = 0.0;
  right.move(input, {0.0, 0.0, -10.0}, 3000);
  EXPECT_LT(glm::length(right.force.wanted_n), 0.1) << "drawn back in its tube";
  input.pose.position_lps_mm = {0.0, 0.0, -10.0};
  right.move(input, {0.0, 0.0, 10.0}, 1500);
  EXPECT_EQ(right.force.wanted_n, glm::dvec3(0.0));
  input.pose.position_lps_mm = {0.0, 0.0, 10.0};
  right.peak_n = 0.0;
  const double end_mm = right.states[1].needle.track.sheath_mm;
  EXPECT_GT(end_mm, 33.0) << "in kidney";
  right.move(input, {0.0, 0.0, 1.0 - end_mm}, 4000);
  EXPECT_LT(right.peak_n, 0.1) << "skin, fat and muscle are the tube's";
  input.pose.position_lps_mm = {0.0, 0.0, 1.0 - end_mm};
  right.move(input, {0.0, 0.0, -68.0}, 2000);
  EXPECT_GT(right.peak_n, bare_tip_n) << "kidney, once it leaves the tube";
  // Beside it, it is a needle as any other.
  input.pose.position_lps_mm = {0.0, 0.0, -68.0};
  right.move(input, {0.0, 0.0, 10.0}, 4000);
  right.rest(holding(Tool::none, {-20.0, 0.0, 10.0}), 1);
  input.pose.position_lps_mm = {-20.0, 0.0, 10.0};
  right.rest(input, 1);
  right.peak_n = 0.0;
  right.move(input, {-20.0, 0.0, -55.0}, 4000);
  EXPECT_NEAR(right.peak_n, bare.peak_n, 0.02);
  EXPECT_LE(right.most_step_n, kMostStepN + kRounding);
}

// The law of touch and the tip are the case's: what was published is bit for bit as it was.
TEST(TwoHands, ACasesLawOfTouchAndTipAreFelt) {
  const auto course = [&](const cases::Touch& touch) {
    cases::Case scene = flat_body();
    scene.touch = touch;
    Right right(scene);
    std::vector<double> n;
    for (int i = 0; i < 2000; ++i)
      n.push_back(right.tick(holding(Tool::needle, {0.0, 0.0, 5.0 - 0.03 * i})).wanted_n.z);
    return n;
  };
  const auto published = course({});
  EXPECT_EQ(course({.tip = cases::NeedleTip::trocar}), published) << "whatever its tip says";
  const auto chiba = course({.law = cases::TouchLaw::by_speed});
  const auto trocar = course({cases::NeedleTip::trocar, cases::TouchLaw::by_speed});
  EXPECT_NE(chiba, published);
  EXPECT_LT(*std::max_element(chiba.begin(), chiba.end()), *std::max_element(published.begin(), published.end()))
      << "30 mm/s is faster than the rows' speed";
  EXPECT_GT(trocar.back(), 1.1 * chiba.back());
}

// What the needle tells of an organ: nothing on the way, its capsule's force before it opens, the tip's in it.
TEST(TwoHands, TheOrganThatIsPressedIsTold) {
  Right right(flat_body());
  double before_n = 0.0;
  bool opened = false;
  for (int i = 0; i < 2000; ++i) {
    right.tick(holding(Tool::needle, {0.0, 0.0, 5.0 - 0.03 * i}));
    const HeldNeedleState& needle = right.states[1].needle;
    const double tip_n = needle.drag.tip_n;
    if (needle.drag.organ != TissueClass::kidney) {
      EXPECT_EQ(needle.drag.organ_n, 0.0);
      EXPECT_LT(needle.track.cut_mm, 31.0) << "kidney begins there";
    } else if (needle.track.opened < 4) {
      EXPECT_LE(needle.drag.organ_n, tip_n) << "muscle before it bears the rest";
      EXPECT_LE(std::abs(needle.drag.organ_n - before_n), 0.1) << "it begins without a jump";
      before_n = needle.drag.organ_n;
    } else {
      opened = true;
      EXPECT_EQ(needle.drag.organ_n, tip_n);
    }
  }
  EXPECT_TRUE(opened);
  EXPECT_GT(before_n, 1.5) << "N, on the capsule";
}

TEST(TwoHands, TissueHoldsTheNeedleSideways) {
  Right right(flat_body());
  right.move(holding(Tool::needle, {0.0, 0.0, 10.0}), {0.0, 0.0, -25.0}, 1500);
  right.rest(holding(Tool::needle, {0.0, 0.0, -25.0}), 500);
  EXPECT_NEAR(right.force.wanted_n.x, 0.0, 1e-6);
  right.move(holding(Tool::needle, {0.0, 0.0, -25.0}), {3.0, 0.0, -25.0}, 300);
  right.rest(holding(Tool::needle, {3.0, 0.0, -25.0}), 500);
  const double inserted = inserted_mm(right.states[1].needle.path.span(), 25.0, right.states[1].needle.track);
  const double expected_n_mm =
      side_stiffness_n_mm(inserted, bending_stiffness_n_mm2(*cases::gauge(kTableGauge)), kFoundationNMm2);
  EXPECT_NEAR(right.force.wanted_n.x, -3.0 * expected_n_mm, 0.02 * 3.0 * expected_n_mm);
  EXPECT_NEAR(right.force.wanted_n.y, 0.0, 1e-6);
  // Turned about the tip, the shaft at the skin goes the other way.
  Right turned(flat_body());
  turned.move(holding(Tool::needle, {0.0, 0.0, 10.0}), {0.0, 0.0, -25.0}, 1500);
  turned.rest(holding(Tool::needle, {0.0, 0.0, -25.0}), 500);
  for (int i = 0; i <= 500; ++i)
    turned.tick(holding(Tool::needle, {0.0, 0.0, -25.0}, glm::normalize(glm::dvec3(-0.5 * i / 500.0, 0.0, -1.0))));
  turned.rest(holding(Tool::needle, {0.0, 0.0, -25.0}, glm::normalize(glm::dvec3(-0.5, 0.0, -1.0))), 500);
  EXPECT_NEAR(turned.force.wanted_n.x, -12.5 * expected_n_mm, 0.02 * 12.5 * expected_n_mm);
}

TEST(TwoHands, AProbePressesAsItsLawSays) {
  const cases::Case& scene = flat_body();
  const ProbeSettings settings;
  const SoftContact contact{settings.radius_mm, settings.shear_n_mm2, stiffness_n_mm(*find_arm_model("omni"))};
  for (const double x_mm : {-20.0, 35.0}) {
    Right right(scene);
    right.move(holding(Tool::probe, {x_mm, 0.0, 5.0}), {x_mm, 0.0, -4.0}, 900);
    right.rest(holding(Tool::probe, {x_mm, 0.0, -4.0}), 1000);
    // Bone begins midway between the voxels' centres at 5 and 7, or 89 and 91 mm.
    const double expected_n = contact.force_n(4.0, x_mm > 20.0 ? 1.0 / 6.0 : 1.0 / 90.0);
    EXPECT_NEAR(right.force.motor_n.z, expected_n, 0.01 * expected_n) << x_mm;
    EXPECT_NEAR(right.force.motor_n.x, 0.0, 1e-9);
    EXPECT_LE(right.most_step_n, kMostStepN + kRounding);
  }
}

TEST(TwoHands, AProbeThatSlidesOntoARibFeelsIt) {
  Right right(flat_body());
  right.move(holding(Tool::probe, {-20.0, 0.0, 5.0}), {-20.0, 0.0, -4.0}, 900);
  right.rest(holding(Tool::probe, {-20.0, 0.0, -4.0}), 500);
  const double soft_n = right.force.motor_n.z;
  right.most_step_n = 0.0;
  right.move(holding(Tool::probe, {-20.0, 0.0, -4.0}), {35.0, 0.0, -4.0}, 500);
  right.rest(holding(Tool::probe, {35.0, 0.0, -4.0}), 500);
  EXPECT_GT(right.force.motor_n.z, 2.0 * soft_n);
  EXPECT_LT(right.force.motor_n.x, -0.05) << "friction";
  EXPECT_LE(right.most_step_n, kMostStepN + kRounding);
}

// The skin's own surface, and the bone's in the CT with nothing over it: springs from the device to where it is
// held.
TEST(TwoHands, AFingerPalpatesAndAPointerFindsBone) {
  const double stiffness = stiffness_n_mm(*find_arm_model("omni"));
  Right finger(flat_body());
  finger.move(holding(Tool::finger, {-20.0, 0.0, 5.0}), {-20.0, 0.0, -2.0}, 700);
  finger.rest(holding(Tool::finger, {-20.0, 0.0, -2.0}), 500);
  EXPECT_NEAR(finger.force.motor_n.z, 2.0 * stiffness, 0.01 * stiffness);
  finger.move(holding(Tool::finger, {-20.0, 0.0, -2.0}), {10.0, 0.0, -2.0}, 600);
  EXPECT_NEAR(finger.force.motor_n.x, -0.3 * 2.0 * stiffness, 0.05 * stiffness) << "friction";
  EXPECT_LE(finger.most_step_n, kMostStepN + kRounding);

  Right pointer(flat_body());
  pointer.move(holding(Tool::pointer, {40.0, 0.0, 5.0}), {40.0, 0.0, -4.0}, 900);
  EXPECT_EQ(pointer.force.motor_n, glm::dvec3(0.0)) << "skin and fat are not there for it";
  pointer.move(holding(Tool::pointer, {40.0, 0.0, -4.0}), {40.0, 0.0, -7.0}, 300);
  pointer.rest(holding(Tool::pointer, {40.0, 0.0, -7.0}), 500);
  // Bone begins midway between voxels' centres at 5 and 7 mm. The surface is smoothed by a kernel of 0.86 voxels sd
  // (cubic B-spline, and 0.2 to each side); 250 HU, a quarter of the way from 40 to 900, is 0.69 sd before.
  EXPECT_NEAR(pointer.force.motor_n.z, (1.0 + 0.69 * 0.86 * 2.0) * stiffness, 0.15 * stiffness);
  EXPECT_LE(pointer.most_step_n, kMostStepN + kRounding);
}

TEST(TwoHands, ToolsAreSwappedWithoutAJump) {
  Right right(flat_body());
  const glm::dvec3 inside(0.0, 0.0, -25.0);
  right.move(holding(Tool::needle, {0.0, 0.0, 10.0}), inside, 700);
  ASSERT_GT(glm::length(right.force.motor_n), 0.8);
  const auto swap_to = [&](Tool tool) {
    right.most_step_n = 0.0;
    right.rest(holding(tool, inside), 1000);
    EXPECT_LE(right.most_step_n, kMostStepN + kRounding);
    return glm::length(right.force.motor_n);
  };
  EXPECT_EQ(swap_to(Tool::none), 0.0);
  EXPECT_GT(swap_to(Tool::probe), 1.0) << "its head is deep in the skin";
  EXPECT_LE(right.most_step_n, 0.05) << "and its force comes in within 0.3 s";
  EXPECT_EQ(swap_to(Tool::needle), 0.0) << "taken up inside the body";
  right.move(holding(Tool::needle, inside), {0.0, 0.0, -40.0}, 500);
  EXPECT_EQ(right.force.motor_n, glm::dvec3(0.0));
  right.move(holding(Tool::needle, {0.0, 0.0, -40.0}), {0.0, 0.0, 10.0}, 500);
  right.peak_n = 0.0;
  right.move(holding(Tool::needle, {0.0, 0.0, 10.0}), inside, 1500);
  EXPECT_GT(right.peak_n, 2.4) << "once out, it is a needle again, and the hole is gone with the tool";
  EXPECT_LE(right.most_step_n, kMostStepN + kRounding);
}

// S16: whatever the fault, no force is left after 20 ms, and none comes back as a jump.
TEST(TwoHands, FaultsFadeAndComeBackSlowly) {
  const glm::dvec3 inside(0.0, 0.0, -25.0);
  const HandInput held = holding(Tool::needle, inside);
  HandInput silent = held, nan_pose = held, no_axis = held, late = held;
  silent.healthy = false;
  nan_pose.pose.position_lps_mm.y = kNan;
  no_axis.pose.axis = glm::dvec3(0.0);
  late.delay_ticks = kMostDelayTicks + 1;
  for (const HandInput& fault : {silent, nan_pose, no_axis, late}) {
    Right right(flat_body());
    right.move(holding(Tool::needle, {0.0, 0.0, 10.0}), inside, 700);
    right.rest(held, 500);
    const double before_n = glm::length(right.force.motor_n);
    ASSERT_GT(before_n, 0.5);
    for (int i = 1; i <= 20; ++i) {
      right.tick(fault);
      EXPECT_LE(glm::length(right.force.motor_n), before_n * (1.0 - i / 20.0) + 1e-9) << i;
    }
    EXPECT_NEAR(glm::length(right.force.motor_n), 0.0, 1e-9);
    right.rest(fault, 100);
    right.most_step_n = 0.0;
    right.rest(held, 1000);
    EXPECT_LE(right.most_step_n, 0.02) << "back within 0.3 s";
    EXPECT_NEAR(glm::length(right.force.motor_n), before_n, 0.05 * before_n) << "it still holds";
  }
}

TEST(TwoHands, WhatAHandDoesUnseenStretchesNothing) {
  const glm::dvec3 inside(0.0, 0.0, -25.0), beside(8.0, 0.0, -25.0);
  Right right(flat_body());
  right.move(holding(Tool::needle, {0.0, 0.0, 10.0}), inside, 700);
  right.rest(holding(Tool::needle, inside), 500);
  HandInput silent = holding(Tool::needle, inside);
  silent.healthy = false;
  right.rest(silent, 50);
  right.rest(holding(Tool::needle, beside), 1000);
  EXPECT_NEAR(right.force.wanted_n.x, 0.0, 1e-6) << "8 mm aside, unseen";
  EXPECT_GT(right.force.wanted_n.z, 0.5) << "and in the tissue as before";
  right.move(holding(Tool::needle, beside), {9.0, 0.0, -25.0}, 100);
  EXPECT_LT(right.force.wanted_n.x, -0.02) << "seen again, it does";
}

TEST(TwoHands, AStallIsAFaultAndAHandThatWentElsewhereStartsAnew) {
  const glm::dvec3 inside(0.0, 0.0, -25.0), elsewhere(-25.0, 0.0, -60.0);
  Right right(flat_body());
  right.move(holding(Tool::needle, {0.0, 0.0, 10.0}), inside, 700);
  right.tick(holding(Tool::needle, inside), 0.030);
  EXPECT_EQ(right.force.motor_n, glm::dvec3(0.0)) << "30 ms late: what was to fade is over";
  right.most_step_n = 0.0;
  right.rest(holding(Tool::needle, inside), 1000);
  EXPECT_LE(right.most_step_n, 0.02);
  EXPECT_GT(glm::length(right.force.motor_n), 0.5);
  HandInput silent = holding(Tool::needle, inside);
  silent.healthy = false;
  right.rest(silent, 50);
  right.rest(holding(Tool::needle, elsewhere), 1000);
  EXPECT_EQ(right.force.wanted_n, glm::dvec3(0.0)) << "as taken up inside the body";
  for (const double late_s : {0.002, 0.010, 0.019}) {
    Right stays(flat_body());
    stays.move(holding(Tool::probe, {0.0, 0.0, 10.0}), {0.0, 0.0, -8.0}, 700);
    stays.rest(holding(Tool::probe, {0.0, 0.0, -8.0}), 500);
    stays.most_step_n = 0.0;
    stays.tick(holding(Tool::probe, {0.0, 0.0, -8.0}), late_s);
    EXPECT_LE(stays.most_step_n, 1e-3) << "below 20 ms it goes on";
  }
}

// K is the sum of all springs' slopes: the most that the force changes per mm, on any way in, is bound / 1.4.
TEST(TwoHands, MoreDelayIsSofter) {
  const ArmModel omni = *find_arm_model("omni");
  double last_n_mm = std::numeric_limits<double>::infinity();
  for (int delay = 0; delay <= kMostDelayTicks; ++delay) {
    ArmModel delayed = omni;
    delayed.delay_ticks = delay;
    const double most_n_mm = stiffness_n_mm(delayed);
    double steepest_n_mm = 0.0;
    for (const Tool tool : {Tool::needle, Tool::probe}) {
      Right right(flat_body());
      const double x_mm = tool == Tool::probe ? 35.0 : 0.0, step_mm = 0.002;  // slow: the damper says nothing
      double before_n = 0.0;
      for (double z_mm = 0.5; z_mm > -11.0; z_mm -= step_mm) {
        HandInput input = holding(tool, {x_mm, 0.0, z_mm});
        input.delay_ticks = delay;
        right.tick(input);
        const double now_n = right.force.wanted_n.z;
        if (!right.force.ruptured) steepest_n_mm = std::max(steepest_n_mm, (now_n - before_n) / step_mm);
        before_n = now_n;
      }
    }
    // The damper adds up to B / tick · d²F/dz² · step; bone's 50 ms a little more.
    EXPECT_LE(steepest_n_mm, 1.03 * most_n_mm) << delay;
    EXPECT_GE(steepest_n_mm, 0.9 * most_n_mm) << delay;
    EXPECT_LE(most_n_mm, last_n_mm);
    last_n_mm = most_n_mm;
  }
}

TEST(TwoHands, DelayThatGrowsSoftensAtOnceThatShrinksOnceNothingIsTouched) {
  Right right(flat_body());
  HandInput input = holding(Tool::probe, {0.0, 0.0, -9.0});
  right.move(holding(Tool::probe, {0.0, 0.0, 5.0}), {0.0, 0.0, -9.0}, 900);
  right.rest(input, 500);
  const double stiff_n = right.force.motor_n.z;
  input.delay_ticks = 3;
  right.most_step_n = 0.0;
  right.rest(input, 500);
  const double soft_n = right.force.motor_n.z;
  EXPECT_LT(soft_n, 0.95 * stiff_n);
  EXPECT_LE(right.most_step_n, kMostStepN + kRounding);
  input.delay_ticks = 1;
  right.rest(input, 500);
  EXPECT_NEAR(right.force.motor_n.z, soft_n, 1e-9) << "still touched: a spring that stiffens would give energy";
  right.move(input, {0.0, 0.0, 5.0}, 900);
  right.move(holding(Tool::probe, {0.0, 0.0, 5.0}), {0.0, 0.0, -9.0}, 900);
  right.rest(input, 500);
  EXPECT_NEAR(right.force.motor_n.z, stiff_n, 1e-6);
}

TEST(TwoHands, GravityIsBorneUpwards) {
  cases::Case scene = flat_body();
  auto settings = two_omnis();
  settings[1].carried_kg = 0.05;
  for (const auto position : {cases::PatientPosition::supine, cases::PatientPosition::prone}) {
    scene.position = position;
    Right right(scene, settings);
    right.rest(holding(Tool::none, {0.0, 0.0, 50.0}), 1000);
    const double up = position == cases::PatientPosition::supine ? -1.0 : 1.0;  // LPS: +y is posterior
    EXPECT_NEAR(right.force.motor_n.y, up * 0.05 * 9.80665, 1e-9);
    EXPECT_EQ(right.force.motor_n.x, 0.0);
    EXPECT_LE(right.most_step_n, 0.02);
  }
}

// Both hands at work: a needle in and out with some sway, a probe that presses and slides.
HandInputs at_work(int tick, Handedness handedness, bool mirrored) {
  const double t_s = 0.001 * tick, wave = std::sin(2.0 * t_s), sway = std::sin(11.0 * t_s);
  HandInput needle = holding(Tool::needle, {-8.3 + 0.7 * sway, 3.1 + 1.5 * wave, -18.0 - 25.0 * wave},
                             glm::normalize(glm::dvec3(0.1 + 0.02 * sway, 0.05, -1.0)));
  HandInput probe = holding(Tool::probe, {15.0 + 6.0 * std::sin(t_s), -4.0, -8.0 - 6.0 * sway},
                            glm::normalize(glm::dvec3(-0.2, 0.1 * wave, -1.0)));
  if (mirrored)
    for (HandInput* hand : {&needle, &probe}) {
      hand->pose.position_lps_mm.x *= -1.0;
      hand->pose.axis.x *= -1.0;
    }
  HandInputs inputs;
  for (const Side side : {Side::left, Side::right})
    inputs[static_cast<std::size_t>(side)] = tool_of(handedness, side) == Tool::needle ? needle : probe;
  return inputs;
}

TEST(TwoHands, ALeftHandedUserInTheMirrorFeelsTheMirror) {
  const cases::Case body = bumpy_body(false), image = bumpy_body(true);
  const TwoHands hands(body, two_omnis()), left_handed(image, two_omnis());
  HandStates states{}, left_states{};
  double most_n[2] = {0.0, 0.0};
  for (int tick = 0; tick < 6000; ++tick) {
    const HandForces forces = hands.advance(at_work(tick, Handedness::right, false), kTickS, states);
    const HandForces mirrored = left_handed.advance(at_work(tick, Handedness::left, true), kTickS, left_states);
    for (std::size_t side = 0; side < 2; ++side) {
      glm::dvec3 back_n = mirrored[1 - side].motor_n;
      back_n.x *= -1.0;
      ASSERT_NEAR(glm::distance(forces[side].motor_n, back_n), 0.0, 1e-6) << tick;
      most_n[side] = std::max(most_n[side], glm::length(back_n));
    }
  }
  EXPECT_GT(most_n[0], 0.5);
  EXPECT_GT(most_n[1], 2.0);
}

TEST(TwoHands, HandsAreExchangedBitForBit) {
  const cases::Case body = bumpy_body(false);
  const TwoHands hands(body, two_omnis());
  HandStates states{}, exchanged_states{};
  for (int tick = 0; tick < 4000; ++tick) {
    const HandForces forces = hands.advance(at_work(tick, Handedness::right, false), kTickS, states);
    const HandForces exchanged = hands.advance(at_work(tick, Handedness::left, false), kTickS, exchanged_states);
    ASSERT_EQ(std::memcmp(&forces[0].motor_n, &exchanged[1].motor_n, sizeof(glm::dvec3)), 0) << tick;
    ASSERT_EQ(std::memcmp(&forces[1].motor_n, &exchanged[0].motor_n, sizeof(glm::dvec3)), 0) << tick;
  }
}

TEST(TwoHands, AllocatesNothingAndNeverJumps) {
  const cases::Case body = bumpy_body(false);
  const TwoHands hands(body, two_omnis());
  HandStates states{};
  HandForces last{};
  int ruptures = 0;
  long allocated = 0;
  for (int tick = 0; tick < 8000; ++tick) {
    HandInputs inputs = at_work(tick, tick % 3000 < 2500 ? Handedness::right : Handedness::left, false);
    inputs[0].delay_ticks = tick / 500 % 4;
    const long before = fixtures::allocations();
    const HandForces forces = hands.advance(inputs, kTickS, states);
    allocated += fixtures::allocations() - before;
    for (std::size_t side = 0; side < 2; ++side) {
      EXPECT_LE(glm::distance(forces[side].motor_n, last[side].motor_n), kMostStepN + kRounding) << tick;
      EXPECT_LE(glm::length(forces[side].motor_n), 3.3 + kRounding);
      ruptures += forces[side].ruptured ? 1 : 0;
    }
    last = forces;
  }
  EXPECT_EQ(allocated, 0);
  EXPECT_GT(ruptures, 2);
}

TEST(TwoHands, WithoutASkinThereIsNoForce) {
  cases::Case empty = flat_body();
  empty.skin = {};
  empty.skin_index = {};
  for (const Tool tool : {Tool::needle, Tool::probe}) {
    Right right(empty);
    right.move(holding(tool, {0.0, 0.0, 10.0}), {0.0, 0.0, -25.0}, 500);
    EXPECT_EQ(right.force.motor_n, glm::dvec3(0.0));
  }
}

}  // namespace
}  // namespace seldinger::haptics
