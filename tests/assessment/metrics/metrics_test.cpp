// Endpoint, punctures, entry, forces and times: closed forms and edge rules. What every metric keeps is in
// laws_test.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "tests/assessment/metrics/straight_attempts.h"

namespace seldinger::assessment {
namespace {

TEST(Endpoint, AccessNeedleCountsFromTheTip) {
  const auto recording = straight([](double t) { return std::fmin(ramp(t, 25.0), 57.0); }, 5.0);
  EXPECT_EQ(number(recording, "hit"), 1.0);
  EXPECT_NEAR(number(recording, "tip_target_dist"), 3.0, 1e-12);
  EXPECT_NEAR(number(recording, "tip_target_surface"), -3.0, 1e-12);
  EXPECT_NEAR(number(recording, "tip_target_axial"), 3.0, 1e-12);
  EXPECT_NEAR(number(recording, "tip_target_lateral"), 0.0, 1e-12);
  EXPECT_EQ(value(recording, "core_in_target").reason, "not_a_core_needle");
}

TEST(Endpoint, ASweepThroughTheTargetIsNoHit) {
  const auto recording = straight([](double t) { return ramp(t, 20.0); }, 5.0);
  EXPECT_NEAR(number(recording, "tip_target_dist"), 20.0, 1e-9);
  EXPECT_EQ(number(recording, "hit"), 0.0);
}

TEST(Endpoint, CoreNeedleCountsFromTheFiredNotch) {
  AttemptSetting core = setting();
  core.instrument.kind = cases::InstrumentKind::core;  // throw 22, notch 18, dead tip 4
  // Stopped at the near edge (54): the notch reaches from 54 to 72 and holds the 12 mm of the target.
  const auto edge = straight([](double t) { return std::fmin(ramp(t, 25.0), 54.0); }, 5.0);
  EXPECT_NEAR(number(edge, "core_in_target", core), 12.0, 1e-12);
  EXPECT_EQ(number(edge, "hit", core), 1.0);
  EXPECT_NEAR(number(edge, "tip_target_dist", core), 3.0, 1e-12);
  // 40: notch 40..58 holds 4 mm of it, under 5.
  const auto shallow = straight([](double t) { return std::fmin(ramp(t, 25.0), 40.0); }, 5.0);
  EXPECT_NEAR(number(shallow, "core_in_target", core), 4.0, 1e-12);
  EXPECT_EQ(number(shallow, "hit", core), 0.0);
}

TEST(Endpoint, NoTriggerAndNoTargetAreNullWithTheirReason) {
  auto recording = straight([](double t) { return ramp(t, 20.0); }, 3.0);
  recording.endpoint.reset();
  EXPECT_EQ(value(recording, "hit").reason, "no_endpoint");
  EXPECT_FALSE(value(recording, "tip_target_dist").value.has_value());
  AttemptSetting bare = setting();
  bare.target.reset();
  EXPECT_EQ(value(straight([](double t) { return ramp(t, 20.0); }, 3.0), "hit", bare).reason, "no_target");
}

TEST(SkinPunctures, ScrapesAndShortTouchesAreNone) {
  EXPECT_EQ(number(straight(in_turn({{1.0, -5.0}, {9.0, 1.9}}), 3.0), "skin_punctures"), 0.0);
  // Deeper than 2 mm for the last 12.5 ms of the way in, for as long as it stays, and for as much of the way out.
  const auto touch = [](double seconds) { return in_turn({{1.0, -5.0}, {1.1 + seconds, 3.0}, {9.0, -5.0}}); };
  EXPECT_EQ(number(straight(touch(0.06), 3.0), "skin_punctures"), 0.0);
  EXPECT_EQ(number(straight(touch(0.1), 3.0), "skin_punctures"), 1.0);
}

TEST(SkinPunctures, TheNextNeedsTheTipOneMillimetreOutside) {
  const auto twice = [](double out_mm) { return in_turn({{1.0, -5.0}, {2.0, 10.0}, {3.0, out_mm}, {9.0, 10.0}}); };
  EXPECT_EQ(number(straight(twice(-0.9), 4.0), "skin_punctures"), 1.0);
  EXPECT_EQ(number(straight(twice(-0.9), 4.0), "withdrawals_full"), 0.0);
  EXPECT_EQ(number(straight(twice(-1.1), 4.0), "skin_punctures"), 2.0);
  EXPECT_EQ(number(straight(twice(-1.1), 4.0), "withdrawals_full"), 1.0);
}

TEST(SkinPunctures, ANeedleInThroughTheVolumesEndIsNone) {
  const cases::MeshIndex cut(fixtures::box_mesh({-200, 0, -200}, {200, 200, 200}, true));
  AttemptSetting s = setting();
  s.skin = &cut;
  cases::Recording recording;
  for (int i = 0; i <= 300; ++i) {
    cases::PoseSample pose;
    pose.t_s = i * 0.01;
    pose.tip_lps_mm = {0.0, 100.0, 250.0 - i};
    recording.poses.push_back(pose);
  }
  EXPECT_EQ(number(recording, "skin_punctures", s), 0.0);
}

TEST(WithdrawalsPartial, HysteresisIsAFifthOfTheDepthBetweenTwoAndFiveMillimetres) {
  const auto back_by = [](double depth_mm, double back_mm) {
    return in_turn({{1.0, -5.0}, {2.0, depth_mm}, {3.0, depth_mm - back_mm}, {9.0, depth_mm}});
  };
  const auto count = [&](double depth_mm, double back_mm) {
    return number(straight(back_by(depth_mm, back_mm), 4.0), "withdrawals_partial");
  };
  EXPECT_EQ(count(5.0, 1.9), 0.0);
  EXPECT_EQ(count(5.0, 2.1), 1.0);
  EXPECT_EQ(count(15.0, 2.9), 0.0);
  EXPECT_EQ(count(15.0, 3.1), 1.0);
  EXPECT_EQ(count(60.0, 4.9), 0.0);
  EXPECT_EQ(count(60.0, 5.1), 1.0);
}

TEST(WithdrawalsPartial, JitterAndLeavingTheSkinAreNone) {
  const auto in = in_turn({{1.0, -5.0}, {9.0, 40.0}});
  const auto jitter = [&](double t) { return in(t) + (t < 1.0 ? 0.0 : 2.4 * std::sin(30.0 * t)); };
  EXPECT_EQ(number(straight(jitter, 6.0), "withdrawals_partial"), 0.0);
  const auto out = in_turn({{1.0, -5.0}, {2.0, 40.0}, {3.0, -5.0}, {9.0, 40.0}});
  EXPECT_EQ(number(straight(out, 4.0), "withdrawals_partial"), 0.0);
  EXPECT_EQ(number(straight(out, 4.0), "withdrawals_full"), 1.0);
}

TEST(Entry, IsHeldAgainstThePlan) {
  AttemptSetting s = setting();
  const auto recording = straight([](double t) { return ramp(t, 20.0); }, 3.0);
  EXPECT_EQ(value(recording, "entry_angle_error", s).reason, "no_plan");
  s.plan = PlannedEntry{{3.0, 0.0, 4.0}, {std::sin(0.2), std::cos(0.2), 0.0}};
  EXPECT_NEAR(number(recording, "entry_angle_error", s), 0.2 * 180.0 / std::numbers::pi, 1e-9);
  EXPECT_NEAR(number(recording, "entry_point_error", s), 5.0, 1e-9);
  EXPECT_EQ(value(straight([](double) { return 20.0; }, 3.0), "entry_angle_error", s).reason, "never_punctured");
}

TEST(ClosestApproach, IsOfTheWholeWayAlsoBetweenPoses) {
  // Past the target at 60 mm, 3 mm beside it, fast enough to skip it.
  auto recording = straight([](double t) { return ramp(t, 50.0); }, 3.0, 20.0);
  for (auto& pose : recording.poses) pose.tip_lps_mm.x = 3.0;
  EXPECT_NEAR(number(recording, "closest_approach"), 3.0, 1e-9);
  EXPECT_NEAR(number(recording, "tip_target_dist"), std::hypot(70.0, 0.0), 1e-9);
}

TEST(FirstPass, IsAHitByOnePunctureWithoutAWithdrawal) {
  const auto to = [](double depth_mm) { return [=](double t) { return std::fmin(ramp(t, 20.0), depth_mm); }; };
  EXPECT_EQ(number(straight(to(58.0), 5.0), "first_pass_success"), 1.0);
  EXPECT_EQ(number(straight(to(50.0), 5.0), "first_pass_success"), 0.0) << "no hit";
  const auto back = [](double t) {
    return t < 3.0 ? ramp(t, 20.0) : t < 4.0 ? 40.0 - 10.0 * (t - 3.0) : 30.0 + 28.0 * (t - 4.0);
  };
  EXPECT_EQ(number(straight(back, 5.0), "hit"), 1.0);
  EXPECT_EQ(number(straight(back, 5.0), "first_pass_success"), 0.0) << "a partial withdrawal";
  const auto again = [](double t) {
    return t < 1.0 ? 5.0 * t : t < 2.0 ? 5.0 - 10.0 * (t - 1.0) : -5.0 + 21.0 * (t - 2.0);
  };
  EXPECT_EQ(number(straight(again, 5.0), "hit"), 1.0);
  EXPECT_EQ(number(straight(again, 5.0), "first_pass_success"), 0.0) << "a second puncture";
  EXPECT_EQ(value(straight([](double) { return 58.0; }, 5.0), "first_pass_success").reason, "never_punctured");
}

TEST(Forces, ArePeaksUpToTheEndpoint) {
  auto recording = straight([](double t) { return ramp(t, 20.0); }, 3.0);
  EXPECT_EQ(value(recording, "force_peak_axial").reason, "no_device");
  recording.forces = {{0.5, 1.0, 0.2, 0.0}, {1.0, -3.0, 0.7, 0.0}, {2.0, 2.5, 0.1, 0.0}, {3.5, 9.0, 9.0, 0.0}};
  EXPECT_EQ(number(recording, "force_peak_axial"), 2.5) << "a pull back is no push";
  EXPECT_EQ(number(recording, "lateral_force_peak"), 0.7);
}

// 2.5 N before, of a mouse that gives none.
TEST(Forces, AreMeasuredWhereAnArmLedTheNeedle) {
  using enum cases::EventKind;
  auto recording = straight([](double t) { return ramp(t, 20.0); }, 3.0);  // in tissue from 1 s on
  recording.forces = {{0.5, 1.0, 0.2, 0.0}, {2.0, 2.5, 0.7, 0.0}};
  for (const char* id : {"force_peak_axial", "lateral_force_peak"}) {
    const double as_before = number(recording, id);
    recording.events = {{0.1, sign_in}};
    EXPECT_EQ(number(recording, id), as_before) << "what led is not known";
    recording.events = {{0.3, needle_by_arm}, {0.3, probe_by_mouse}};
    EXPECT_EQ(number(recording, id), as_before);
    recording.events = {{0.001, needle_by_mouse}, {0.3, needle_by_arm}};
    EXPECT_EQ(number(recording, id), as_before) << "in time";
    for (const auto& events : {std::vector<cases::Event>{{0.001, needle_by_mouse}, {0.002, probe_by_arm}},
                               {{0.001, needle_by_arm}, {2.0, needle_by_gamepad}},
                               {{0.001, needle_by_space_mouse}, {1.5, needle_by_arm}}}) {
      recording.events = events;
      EXPECT_EQ(value(recording, id).reason, "no_arm") << id;
    }
    recording.events.reset();
  }
}

TEST(Forces, OfAnArmThatLedTheNeedleInTissueStayWhateverTakesItUpInTheAir) {
  using enum cases::EventKind;
  auto recording = straight([](double t) { return t < 3.0 ? ramp(t, 20.0) : ramp(6.0 - t, 20.0); }, 6.0);
  recording.endpoint.reset();
  recording.forces = {{0.5, 1.0, 0.2, 0.0}, {2.0, 2.5, 0.7, 0.0}};
  recording.events = {{0.001, needle_by_arm}, {5.5, needle_by_mouse}};
  EXPECT_EQ(number(recording, "force_peak_axial"), 2.5);    // before: null, no_arm
  EXPECT_EQ(number(recording, "lateral_force_peak"), 0.7);  // before: null, no_arm
  recording.events = {{0.001, needle_by_arm}, {4.5, needle_by_mouse}};
  EXPECT_EQ(value(recording, "force_peak_axial").reason, "no_arm") << "in tissue until 5 s";
}

TEST(Times, InTissueAndFromPunctureToTrigger) {
  const auto recording = straight([](double t) { return ramp(t, 20.0); }, 5.0);
  EXPECT_NEAR(number(recording, "time_in_tissue"), 4.0, 0.011);
  EXPECT_NEAR(number(recording, "time_puncture_to_target"), 3.9, 0.011) << "from 2 mm of depth on";
  EXPECT_EQ(number(straight([](double) { return -9.0; }, 5.0), "time_in_tissue"), 0.0);
}

TEST(TimeTotal, RunsFromTheFirstPoseToTheEndpoint) {
  auto recording = straight([](double t) { return ramp(t, 20.0); }, 5.0);
  for (auto& pose : recording.poses) pose.t_s += 100.0;
  recording.endpoint->t_s = 103.456;
  EXPECT_NEAR(number(recording, "time_total"), 3.456, 1e-9);
}

TEST(Signals, BadPosesAreRefused) {
  const auto code = [](const std::function<void(cases::Recording&)>& spoil) {
    auto recording = straight([](double t) { return ramp(t, 20.0); }, 1.0);
    spoil(recording);
    const auto signals = make_signals(setting(), recording);
    return signals ? std::string("accepted") : signals.error().code;
  };
  EXPECT_EQ(code([](auto&) {}), "accepted");
  EXPECT_EQ(code([](auto& r) { r.poses.clear(); }), "bad_poses");
  EXPECT_EQ(code([](auto& r) { r.poses[5].tip_lps_mm.x = std::nan(""); }), "bad_poses");
  EXPECT_EQ(code([](auto& r) { r.poses[5].t_s = 0.0; }), "bad_poses");
  EXPECT_EQ(code([](auto& r) { r.poses[5].needle_direction *= 1.5; }), "bad_poses");
  EXPECT_EQ(code([](auto& r) { r.poses[6].t_s = r.poses[5].t_s; }), "accepted");
}

}  // namespace
}  // namespace seldinger::assessment
