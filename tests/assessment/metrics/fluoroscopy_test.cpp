// Tests of assessment/metrics/fluoroscopy: sums and angles of hand-made frames, why there is no value, and that a
// recording made by step() gives what the machine itself added up.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "assessment/registry.h"
#include "assessment/signals/signals.h"
#include "sim/base/rng.h"
#include "sim/engine/step.h"
#include "tests/assessment/metrics/flat_body.h"

namespace seldinger::assessment {
namespace {

AttemptSetting xray_setting() {
  AttemptSetting setting;
  setting.skin = &body();
  setting.target = cases::Lesion{{0.0, 60.0, 0.0}, 6.0, 20.0};
  setting.modality = cases::Modality::xray;
  return setting;
}

// Straight down for `seconds` at 100 Hz, no frames yet.
cases::Recording way(const std::function<double(double)>& depth_mm, double seconds) {
  cases::Recording recording;
  for (int i = 0; i <= static_cast<int>(std::lround(seconds * 100.0)); ++i) {
    cases::PoseSample pose;
    pose.t_s = i / 100.0;
    pose.tip_lps_mm = {0.0, depth_mm(pose.t_s), 0.0};
    pose.needle_direction = {0.0, 1.0, 0.0};
    recording.poses.push_back(pose);
  }
  const cases::PoseSample& last = recording.poses.back();
  recording.endpoint = cases::Endpoint{last.t_s, last.tip_lps_mm, {0.0, 1.0, 0.0}};
  return recording;
}

void expose(cases::Recording& recording, double t_s, const cases::BeamTruth& beam) {
  cases::FrameTruth frame;
  frame.t_s = t_s;
  frame.beam = beam;
  recording.frames.push_back(frame);
}

void hold(cases::Recording& recording, double t_s) {
  cases::FrameTruth frame;
  frame.t_s = t_s;
  frame.live = false;
  recording.frames.push_back(frame);
}

cases::BeamTruth beam(double lao_deg = 0.0, double beam_s = 1.0 / 7.5) {
  return {lao_deg, 0.0, 72.0, 40.0, 0.02, 3.0, 0.6, beam_s, false, false};
}

MetricValue value(const cases::Recording& recording, const std::string& id,
                  const AttemptSetting& setting = xray_setting()) {
  const auto signals = make_signals(setting, recording);
  EXPECT_TRUE(signals.has_value()) << signals.error().text;
  for (const MetricValue& metric : measure_all(*signals))
    if (metric.id == id) return metric;
  ADD_FAILURE() << id;
  return {};
}

double number(const cases::Recording& recording, const std::string& id) {
  const MetricValue metric = value(recording, id);
  EXPECT_TRUE(metric.value.has_value()) << id << ": " << metric.reason;
  return metric.value.value_or(std::nan(""));
}

constexpr const char* kIds[] = {"fluoroscopy_time",
                                "dap",
                                "air_kerma",
                                "beam_while_moving",
                                "collimated_share",
                                "views",
                                "view_angle_max",
                                "hand_in_beam",
                                "longest_advance_between_exposures"};

TEST(FluoroscopyMetrics, OfAnotherModalityAreNull) {
  auto recording = way([](double t) { return 10.0 * t; }, 5.0);
  expose(recording, 1.0, beam());
  AttemptSetting mpr = xray_setting();
  mpr.modality = cases::Modality::mpr;
  for (const char* id : kIds) {
    EXPECT_FALSE(value(recording, id, mpr).value.has_value()) << id;
    EXPECT_EQ(value(recording, id, mpr).reason, "not_xray") << id;
  }
}

TEST(FluoroscopyMetrics, WithoutAPulseSumsAreZeroAndSharesAreNull) {
  const auto recording = way([](double t) { return -20.0 + 10.0 * t; }, 5.0);
  for (const char* id : {"fluoroscopy_time", "dap", "air_kerma", "beam_while_moving", "views", "hand_in_beam"})
    EXPECT_EQ(number(recording, id), 0.0) << id;
  EXPECT_EQ(value(recording, "collimated_share").reason, "no_exposure");
  EXPECT_EQ(value(recording, "view_angle_max").reason, "fewer_than_two_views");
  EXPECT_NEAR(number(recording, "longest_advance_between_exposures"), 30.0, 0.11) << "all of it unseen";
}

TEST(FluoroscopyMetrics, AddUpThePulses) {
  auto recording = way([](double t) { return 10.0 * t; }, 6.0);
  cases::BeamTruth wide = beam(), moving = beam(20.0), hand = beam(0.0, 1.0 / 3.0);
  wide.collimated_share = 0.0;
  moving.arm_moving = true;
  hand.hand_in_beam = true;
  hand.air_kerma_mgy = 0.5;
  hand.dap_mgy_cm2 = 75.0;  // of the same field
  expose(recording, 0.5, wide);
  expose(recording, 1.0, moving);
  expose(recording, 2.0, hand);
  hold(recording, 2.4);
  expose(recording, 7.0, beam());  // after the endpoint
  EXPECT_NEAR(number(recording, "fluoroscopy_time"), 2.0 / 7.5 + 1.0 / 3.0, 1e-12);
  EXPECT_NEAR(number(recording, "dap"), 0.081, 1e-12) << "Gy·cm²";
  EXPECT_NEAR(number(recording, "air_kerma"), 0.54, 1e-12);
  EXPECT_NEAR(number(recording, "beam_while_moving"), 1.0 / 7.5, 1e-12);
  EXPECT_NEAR(number(recording, "hand_in_beam"), 1.0 / 3.0, 1e-12);
  EXPECT_NEAR(number(recording, "collimated_share"), 0.6 * (1.0 / 7.5 + 1.0 / 3.0) / (2.0 / 7.5 + 1.0 / 3.0),
              1e-12);
  EXPECT_EQ(number(recording, "views"), 1.0) << "a pulse while the arm moves is no view";
}

TEST(FluoroscopyMetrics, ViewsAndTheAngleBetweenThem) {
  auto recording = way([](double t) { return 10.0 * t; }, 6.0);
  expose(recording, 1.0, beam(-10.0));
  expose(recording, 1.5, beam(-9.0));
  EXPECT_EQ(number(recording, "views"), 1.0);
  EXPECT_EQ(value(recording, "view_angle_max").reason, "fewer_than_two_views");
  expose(recording, 2.0, beam(25.0));
  EXPECT_EQ(number(recording, "views"), 2.0);
  EXPECT_NEAR(number(recording, "view_angle_max"), 35.0, 1e-9);
}

TEST(FluoroscopyMetrics, CountPulsesAndTheirFastestRate) {
  auto recording = way([](double t) { return 10.0 * t; }, 3.0);
  EXPECT_EQ(number(recording, "pulses"), 0.0);
  EXPECT_EQ(value(recording, "pulse_rate_max").reason, "no_exposure");
  cases::BeamTruth slow = beam(), fast = beam();
  slow.beam_s = 1.0 / 3.0;
  fast.beam_s = 1.0 / 7.5;
  for (const double t_s : {0.5, 1.0}) expose(recording, t_s, slow);
  expose(recording, 1.5, fast);
  hold(recording, 1.7);
  EXPECT_EQ(number(recording, "pulses"), 3.0);
  EXPECT_NEAR(number(recording, "pulse_rate_max"), 7.5, 1e-9);
}

// Poses from a file: what a view shows is known, what the beam did is not.
TEST(FluoroscopyMetrics, AreNullWhereTheBeamWasNotRecorded) {
  auto recording = way([](double t) { return 10.0 * t; }, 2.0);
  cases::FrameTruth frame;
  frame.t_s = 1.0;
  recording.frames.push_back(frame);
  for (const char* id : {"fluoroscopy_time", "dap", "views", "hand_in_beam", "longest_advance_between_exposures"})
    EXPECT_EQ(value(recording, id).reason, "beam_not_recorded") << id;
}

TEST(LongestAdvance, IsFromPulseToPulse) {
  // 10 mm/s into the body from t = 0; pulses at 1, 1.5 and 4 s, the trigger at 6 s.
  auto recording = way([](double t) { return 10.0 * t; }, 6.0);
  for (const double t_s : {1.0, 1.5, 4.0}) expose(recording, t_s, beam());
  EXPECT_NEAR(number(recording, "longest_advance_between_exposures"), 25.0, 0.11);
  expose(recording, 5.9, beam());
  EXPECT_NEAR(number(recording, "longest_advance_between_exposures"), 25.0, 0.11);
  auto seldom = way([](double t) { return 10.0 * t; }, 6.0);
  expose(seldom, 2.0, beam());
  EXPECT_NEAR(number(seldom, "longest_advance_between_exposures"), 40.0, 0.11) << "up to the trigger";
}

TEST(LongestAdvance, BreathPastARestingHandIsNone) {
  // 30 mm in, a pulse each 0.2 s on the way; then the hand rests for 20 s while breath slides 6 mm along the
  // needle.
  auto recording = way([](double t) { return 10.0 * std::min(t, 3.0); }, 23.0);
  for (auto& pose : recording.poses)
    pose.rest_tip_lps_mm =
        pose.tip_lps_mm - glm::dvec3(0.0, pose.t_s < 3.0 ? 0.0 : 3.0 - 3.0 * std::cos(1.5 * (pose.t_s - 3.0)), 0.0);
  recording.endpoint->rest_tip_lps_mm = recording.poses.back().rest_tip_lps_mm;
  for (double t_s = 0.0; t_s < 3.1; t_s += 0.2) expose(recording, t_s, beam());
  EXPECT_LT(number(recording, "longest_advance_between_exposures"), 2.2);  // before: 6
}

TEST(LongestAdvance, AHeldImageShowsNothingAndOutsideIsNoAdvance) {
  auto recording = way([](double t) { return -50.0 + 10.0 * t; }, 8.0);
  expose(recording, 1.0, beam());
  for (double t_s = 1.2; t_s < 8.0; t_s += 0.1) hold(recording, t_s);
  EXPECT_NEAR(number(recording, "longest_advance_between_exposures"), 30.0, 0.11);
}

TEST(LongestAdvance, WhatIsWithdrawnAndInsertedAgainCountsAgain) {
  const auto depth = [](double t) {
    return t < 2.0 ? 10.0 * t : t < 3.0 ? 20.0 - 10.0 * (t - 2.0) : 10.0 + 10.0 * (t - 3.0);
  };
  auto recording = way(depth, 5.0);
  expose(recording, 2.0, beam());  // at 20 mm; then back to 10 and on to 30
  EXPECT_NEAR(number(recording, "longest_advance_between_exposures"), 20.0, 0.11);
}

TEST(LongestAdvance, GapsAreNotBridgedAndNullsHaveReasons) {
  auto gap = way([](double t) { return 10.0 * t; }, 6.0);
  std::erase_if(gap.poses, [](const auto& pose) { return pose.t_s > 1.0 && pose.t_s < 5.0; });
  EXPECT_NEAR(number(gap, "longest_advance_between_exposures"), 10.0, 0.11);
  const auto outside = way([](double t) { return -50.0 + t; }, 6.0);
  EXPECT_EQ(value(outside, "longest_advance_between_exposures").reason, "never_in_tissue");
  auto sparse = way([](double t) { return 10.0 * t; }, 6.0);
  std::erase_if(sparse.poses, [](const auto& pose) { return std::fmod(pose.t_s + 1e-9, 1.0) > 0.005; });
  EXPECT_EQ(value(sparse, "longest_advance_between_exposures").reason, "only_gaps");
  const cases::MeshIndex none;
  AttemptSetting bare = xray_setting();
  bare.skin = &none;
  EXPECT_EQ(value(gap, "longest_advance_between_exposures", bare).reason, "no_skin");
}

TEST(Visibility, UnderXrayCountsLiveTimeAndKnowsNoPlane) {
  auto recording = way([](double t) { return 10.0 * t; }, 10.0);
  AttemptSetting setting = xray_setting();
  setting.approach = cases::Approach::out_of_plane;
  for (int i = 0; i < 10; ++i) {
    expose(recording, 1.0 + i / 7.5, beam());
    recording.frames.back().needle_tip = i < 5;
    recording.frames.back().target = true;
  }
  hold(recording, 1.0 + 10 / 7.5);
  recording.frames.back().target = true;  // still on the screen
  EXPECT_NEAR(value(recording, "vis_needle", setting).value.value_or(-1.0), 0.5, 1e-9);
  EXPECT_NEAR(value(recording, "vis_target", setting).value.value_or(-1.0), 1.0, 1e-9);
  auto brief = way([](double t) { return 10.0 * t; }, 10.0);
  expose(brief, 1.0, beam());
  hold(brief, 1.5);
  EXPECT_EQ(value(brief, "vis_joint", setting).reason, "under_1_s_in_tissue_with_a_live_picture");
}

TEST(FluoroscopyMetrics, AgreeWithWhatTheMachineAddedUp) {
  cases::Case scene;
  scene.picture.modality = cases::Modality::xray;
  cases::Recording recording;
  cases::State state;
  cases::Inputs inputs;
  base::Rng rng(8);
  for (int i = 0; i < 40'000; ++i) {
    if (i % 700 == 0) {  // hands do this and that
      inputs.fluoroscope.pedal = rng.uniform() < 0.7;
      inputs.fluoroscope.lao_speed = rng.uniform() < 0.5 ? rng.normal() : 0.0;
      inputs.fluoroscope.cranial_speed = rng.uniform() < 0.3 ? rng.normal() : 0.0;
      inputs.fluoroscope.pulse_rate = static_cast<int>(rng.uniform() * 3);
      inputs.fluoroscope.collimator = {0.2 + 0.8 * rng.uniform(), 0.2 + 0.8 * rng.uniform()};
    }
    engine::step(scene, inputs, base::kTickS, state);
    const cases::FluoroscopyState& machine = state.fluoroscopy;
    if (i % 10 == 0)
      recording.poses.push_back({state.t_s, state.needle.tip_lps_mm, {0, 0, 1}, {0, 0, 0}, {0, 0, 1}, {1, 0, 0}});
    if (!machine.frame_due) continue;
    const double kerma_mgy = 0.1 * rng.uniform();
    inputs.exposure = {machine.frames,
                       kerma_mgy,
                       2500.0 * (1.0 - machine.collimator.shut_share()) * kerma_mgy,
                       {},
                       rng.uniform() < 0.3};
    expose(recording, state.t_s,
           {machine.arm.lao_deg, machine.arm.cranial_deg, machine.last_technique.kv, machine.last_technique.ma,
            inputs.exposure.air_kerma_mgy, inputs.exposure.dap_mgy_cm2, machine.collimator.shut_share(),
            machine.frame_s, machine.arm_moving, inputs.exposure.hand_in_beam});
  }
  inputs.fluoroscope.pedal = false;
  engine::step(scene, inputs, base::kTickS, state);  // takes in the last report
  const cases::FluoroscopyState& machine = state.fluoroscopy;
  ASSERT_GT(machine.frames, 100U);
  ASSERT_GT(machine.views.count, 2);
  EXPECT_EQ(number(recording, "fluoroscopy_time"), machine.fluoroscopy_time_s);
  EXPECT_EQ(number(recording, "air_kerma"), machine.air_kerma_mgy);
  EXPECT_NEAR(number(recording, "dap"), machine.dap_mgy_cm2 / 1000.0, 1e-12);
  EXPECT_EQ(number(recording, "beam_while_moving"), machine.beam_while_moving_s);
  EXPECT_EQ(number(recording, "hand_in_beam"), machine.hand_in_beam_s);
  EXPECT_NEAR(number(recording, "collimated_share"), machine.collimated_share(), 1e-12);
  EXPECT_EQ(number(recording, "views"), machine.views.count);
  EXPECT_EQ(number(recording, "view_angle_max"), machine.views.widest_deg);
}

}  // namespace
}  // namespace seldinger::assessment
