// Tests of assessment/metrics: closed forms and edge rules. What every metric keeps is in laws_test.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <numbers>

#include "assessment/registry.h"
#include "assessment/signals/motion.h"
#include "assessment/signals/signals.h"
#include "assessment/signals/smoothness.h"
#include "sim/base/rng.h"
#include "tests/fixtures/meshes.h"

namespace seldinger::assessment {
namespace {

// A body that fills y ≥ 0; the needle comes from −y.
const cases::MeshIndex& body() {
  static const cases::MeshIndex kIndex(fixtures::box_mesh({-200, 0, -200}, {200, 200, 200}));
  return kIndex;
}

AttemptSetting setting() {
  AttemptSetting s;
  s.skin = &body();
  s.target = cases::Lesion{{0.0, 60.0, 0.0}, 6.0, 20.0};
  return s;
}

// Tip depth as a function of time, straight down, at rate_hz; all frames show everything.
cases::Recording straight(const std::function<double(double)>& depth_mm, double seconds, double rate_hz = 100.0) {
  cases::Recording recording;
  const int n = static_cast<int>(std::lround(seconds * rate_hz));
  for (int i = 0; i <= n; ++i) {
    cases::PoseSample pose;
    pose.t_s = i / rate_hz;
    pose.tip_lps_mm = {0.0, depth_mm(pose.t_s), 0.0};
    pose.needle_direction = {0.0, 1.0, 0.0};
    recording.poses.push_back(pose);
    recording.frames.push_back({pose.t_s, true, true, true, 10.0});
  }
  recording.endpoint =
      cases::Endpoint{recording.poses.back().t_s, recording.poses.back().tip_lps_mm, {0.0, 1.0, 0.0}};
  return recording;
}

MetricValue value(const cases::Recording& recording, const std::string& id, const AttemptSetting& s = setting()) {
  const auto signals = make_signals(s, recording);
  EXPECT_TRUE(signals.has_value()) << signals.error().text;
  for (const MetricValue& metric : measure_all(*signals))
    if (metric.id == id) return metric;
  ADD_FAILURE() << id;
  return {};
}

double number(const cases::Recording& recording, const std::string& id, const AttemptSetting& s = setting()) {
  const MetricValue metric = value(recording, id, s);
  EXPECT_TRUE(metric.value.has_value()) << id << ": " << metric.reason;
  return metric.value.value_or(std::nan(""));
}

double ramp(double t_s, double mm_s) {
  return -20.0 + mm_s * t_s;
}

// From one depth to the next in a tenth of a second, as a hand may, each kept until its time: what went there from
// one pose to the next would be the tracker's leap.
std::function<double(double)> in_turn(std::vector<std::pair<double, double>> until_s_depth_mm) {
  return [=](double t_s) {
    for (std::size_t i = 0; i < until_s_depth_mm.size(); ++i) {
      const auto& [until_s, depth_mm] = until_s_depth_mm[i];
      if (t_s >= until_s && i + 1 < until_s_depth_mm.size()) continue;
      const double since_s = i == 0 ? 1.0 : t_s - until_s_depth_mm[i - 1].first;
      const double before_mm = i == 0 ? depth_mm : until_s_depth_mm[i - 1].second;
      return before_mm + (depth_mm - before_mm) * std::clamp(since_s / 0.1, 0.0, 1.0);
    }
    return 0.0;
  };
}

TEST(PathTip, AStraightWayIsItsLength) {
  const auto recording = straight([](double t) { return ramp(t, 20.0); }, 3.0);
  EXPECT_NEAR(number(recording, "path_tip"), 60.0, 0.06);
}

TEST(PathTip, AHelixIsItsClosedForm) {
  // Radius 5 mm, pitch 4 mm, three turns: 3·√((2π·5)² + 4²) mm.
  cases::Recording recording;
  for (int i = 0; i <= 1200; ++i) {
    cases::PoseSample pose;
    pose.t_s = i * 0.01;
    const double angle = 2.0 * std::numbers::pi * 3.0 * i / 1200.0;
    pose.tip_lps_mm = {5.0 * std::cos(angle), 20.0 + 4.0 * 3.0 * i / 1200.0, 5.0 * std::sin(angle)};
    recording.poses.push_back(pose);
  }
  EXPECT_NEAR(number(recording, "path_tip"), 95.00865203222506, 0.095);
}

TEST(PathTip, AHelixOfASecondATurnIsItsClosedForm) {
  for (const double rate_hz : {100.0, 1000.0})
    for (const double turn_s : {1.0, 2.0}) {
      cases::Recording recording;
      const int rows = static_cast<int>(std::lround(3.0 * turn_s * rate_hz));
      for (int i = 0; i <= rows; ++i) {
        cases::PoseSample pose;
        pose.t_s = i / rate_hz;
        const double turns = 3.0 * i / rows, angle = 2.0 * std::numbers::pi * turns;
        pose.tip_lps_mm = {5.0 * std::cos(angle), 20.0 + 4.0 * turns, 5.0 * std::sin(angle)};
        pose.needle_direction = {0.0, 1.0, 0.0};
        recording.poses.push_back(pose);
      }
      EXPECT_NEAR(number(recording, "path_tip"), 95.00865203222506, 0.095) << rate_hz << ", " << turn_s;
      EXPECT_NEAR(number(recording, "path_in_tissue"), 95.00865203222506, 0.095) << rate_hz << ", " << turn_s;
    }
}

TEST(PathTip, WhatTremblesWhileItRestsIsNoWay) {
  base::Rng rng(2);
  auto recording = straight([](double t) { return ramp(std::fmin(t, 2.0), 20.0); }, 20.0);
  for (auto& pose : recording.poses) pose.tip_lps_mm += glm::dvec3(rng.normal(), rng.normal(), rng.normal()) * 0.05;
  EXPECT_NEAR(number(recording, "path_tip"), 40.0, 1.2);
  // A move for less than 0.2 s is one, too (version 2 left it out); one on the spot is none.
  const auto brief = [](double seconds, double mm_s) {
    return straight([=](double t) { return 20.0 + mm_s * std::clamp(t - 2.0, 0.0, seconds); }, 5.0);
  };
  EXPECT_NEAR(number(brief(0.1, 20.0), "path_tip"), 2.0, 0.05);
  EXPECT_NEAR(number(brief(0.5, 20.0), "path_tip"), 10.0, 0.05);
}

TEST(PathTip, OnePoseIsZeroAndAGapIsNotBridged) {
  cases::Recording one;
  one.poses.resize(1);
  EXPECT_EQ(number(one, "path_tip"), 0.0);
  auto gap = straight([](double t) { return ramp(t, 10.0); }, 4.0);
  std::erase_if(gap.poses, [](const auto& pose) { return pose.t_s > 1.0 && pose.t_s < 3.0; });
  EXPECT_NEAR(number(gap, "path_tip"), 20.0, 0.1);
  EXPECT_NEAR(number(gap, "gap_share"), 0.5, 0.01);
}

TEST(PathTip, OnlyGapsAreNullNotZero) {
  auto sparse = straight([](double t) { return ramp(t, 10.0); }, 6.0, 1.0);
  for (const char* id : {"path_tip", "skin_punctures", "withdrawals_partial", "withdrawals_full"})
    EXPECT_EQ(value(sparse, id).reason, "only_gaps") << id;
  // Rows exactly a quarter of a second apart are no gap, wherever the clock starts.
  auto quarter = straight([](double t) { return ramp(t, 10.0); }, 6.0, 4.0);
  for (auto& pose : quarter.poses) pose.t_s += 0.1;
  quarter.endpoint->t_s += 0.1;
  EXPECT_EQ(number(quarter, "gap_share"), 0.0);
}

TEST(PathTip, NoiseBarelyAddsToIt) {
  base::Rng rng(1);
  auto recording = straight([](double t) { return ramp(t, 20.0); }, 3.0);
  for (auto& pose : recording.poses) pose.tip_lps_mm += glm::dvec3(rng.normal(), rng.normal(), rng.normal()) * 0.05;
  double raw_mm = 0.0;
  for (std::size_t i = 1; i < recording.poses.size(); ++i)
    raw_mm += glm::length(recording.poses[i].tip_lps_mm - recording.poses[i - 1].tip_lps_mm);
  EXPECT_GT(raw_mm, 64.0) << "the noise matters when nothing filters it";
  EXPECT_NEAR(number(recording, "path_tip"), 60.0, 1.5);
}

TEST(LowPass, LosesThreeDecibelsAtItsCutoffAndKeepsSlowMotion) {
  for (const auto& [hz, gain] : {std::pair{1.0, 1.0}, std::pair{10.0, std::sqrt(0.5)}, std::pair{40.0, 0.0}}) {
    std::vector<glm::dvec3> wave;
    for (int i = 0; i < 1000; ++i) wave.emplace_back(std::sin(2.0 * std::numbers::pi * hz * i / 100.0), 0.0, 0.0);
    const auto out = low_pass(wave, 100.0, 10.0);
    double peak = 0.0;
    for (int i = 200; i < 800; ++i) peak = std::fmax(peak, std::abs(out[static_cast<std::size_t>(i)].x));
    EXPECT_NEAR(peak, gain, 0.02) << hz;
    for (int i = 200; i < 800; ++i)
      EXPECT_NEAR(out[static_cast<std::size_t>(i)].x, gain * wave[static_cast<std::size_t>(i)].x, 0.02)
          << "no phase";
  }
}

TEST(PathInTissue, IsClippedAtTheSkinBothWays) {
  const auto in = straight([](double t) { return ramp(t, 20.0) + 0.037; }, 3.0);
  EXPECT_NEAR(number(in, "path_in_tissue"), 40.037, 0.04);
  const auto out = straight([](double t) { return 30.013 - 20.0 * t; }, 3.0);
  EXPECT_NEAR(number(out, "path_in_tissue"), 30.013, 0.03);
  EXPECT_EQ(number(straight([](double t) { return -30.0 + t; }, 3.0), "path_in_tissue"), 0.0);
}

TEST(PathInefficiency, OfAStraightWayIsZeroAndNullNearTheSkin) {
  EXPECT_NEAR(number(straight([](double t) { return ramp(t, 20.0); }, 3.0), "path_inefficiency"), 0.0, 0.1);
  EXPECT_EQ(value(straight([](double t) { return ramp(t, 20.0); }, 1.2), "path_inefficiency").reason,
            "under_5_mm_from_the_skin");
  EXPECT_EQ(value(straight([](double t) { return 20.0 - 20.0 * t; }, 3.0), "path_inefficiency").reason,
            "not_in_tissue_at_the_end");
}

TEST(PathInefficiency, IgnoresJiggleAndCountsLongerExcursions) {
  // In to 40 mm, then to and fro by `swing` mm, `times` times, and on to 60.
  const auto inefficiency = [](double swing_mm, int times, double last_mm) {
    const double speed = 20.0;
    std::vector<double> turns = {-20.0, 40.0};
    for (int i = 0; i < times; ++i) turns.insert(turns.end(), {40.0 - swing_mm, 40.0});
    turns.push_back(last_mm);
    double seconds = 0.0;
    for (std::size_t i = 0; i + 1 < turns.size(); ++i) seconds += std::abs(turns[i + 1] - turns[i]) / speed;
    return number(straight(
                      [=](double t) {
                        double left_mm = t * speed;
                        for (std::size_t i = 0; i + 1 < turns.size(); ++i) {
                          const double way_mm = turns[i + 1] - turns[i];
                          if (left_mm <= std::abs(way_mm)) return turns[i] + std::copysign(left_mm, way_mm);
                          left_mm -= std::abs(way_mm);
                        }
                        return turns.back();
                      },
                      seconds),
                  "path_inefficiency");
  };
  EXPECT_NEAR(inefficiency(4.5, 6, 60.0), 0.0, 1.0);
  EXPECT_NEAR(inefficiency(8.0, 1, 60.0), 100.0 * 16.0 / 60.0, 1.5);
  EXPECT_NEAR(inefficiency(4.5, 1, 38.0), 0.0, 1.5) << "a last turn back by 2 mm";
}

TEST(SweptArea, OfAFanIsItsClosedForm) {
  // 60 mm deep, turned by 10° about the entry: ½ · 60² · π/18 mm².
  for (const double seconds : {1.0, 6.0}) {
    const auto fan = [&](double t) { return 10.0 * std::numbers::pi / 180.0 * std::clamp(t / seconds, 0.0, 1.0); };
    auto recording = straight([](double) { return 0.0; }, seconds + 8.0);
    for (auto& pose : recording.poses) {
      const double angle = fan(pose.t_s - 7.0), depth = std::fmin(-10.0 + 10.0 * pose.t_s, 60.0);
      pose.needle_direction = {std::sin(angle), std::cos(angle), 0.0};
      pose.tip_lps_mm = depth * pose.needle_direction;
    }
    recording.endpoint->tip_lps_mm = recording.poses.back().tip_lps_mm;
    EXPECT_NEAR(number(recording, "swept_area"), 314.1592653589793, 0.314) << seconds;
  }
  EXPECT_NEAR(number(straight([](double t) { return ramp(t, 20.0); }, 4.0), "swept_area"), 0.0, 1e-9);
}

// A minimum-jerk reach: −ln(720/(15/8)²) = −ln 204.8 (closed form).
glm::dvec3 minimum_jerk(double t_s, double length_mm, double seconds) {
  const double s = std::clamp(t_s / seconds, 0.0, 1.0);
  return {0.0, 20.0 + length_mm * s * s * s * (10.0 - 15.0 * s + 6.0 * s * s), 0.0};
}

TEST(Smoothness, OfAMinimumJerkReachIsItsClosedForm) {
  constexpr double kExact = -5.322033893165353;
  for (const double seconds : {2.0, 3.0, 5.0}) {
    std::vector<glm::dvec3> samples;
    for (int i = 0; i <= static_cast<int>(std::lround(seconds * 1000.0)); ++i)
      samples.push_back(minimum_jerk(i / 1000.0, 50.0, seconds));
    const auto raw = log_dimensionless_jerk(samples, 1000.0);
    ASSERT_TRUE(raw.has_value());
    EXPECT_NEAR(*raw, kExact, 0.001 * 5.322) << seconds;
    // Through resampling and filter, rest before and after, with its limits given.
    for (const double rate_hz : {100.0, 1000.0}) {
      auto recording = straight([](double) { return 20.0; }, seconds + 2.0, rate_hz);
      for (auto& pose : recording.poses) pose.tip_lps_mm = minimum_jerk(pose.t_s - 1.0, 50.0, seconds);
      const auto signals = make_signals(setting(), recording);
      ASSERT_TRUE(signals.has_value());
      const auto filtered = log_dimensionless_jerk(*signals, 1.0, 1.0 + seconds);
      ASSERT_TRUE(filtered.has_value());
      EXPECT_NEAR(*filtered, kExact, 0.02 * 5.322) << seconds << " at " << rate_hz;
    }
  }
}

TEST(Smoothness, IsLessOfAnInterruptedReachAndNullOfASlowOne) {
  const auto of = [](const std::function<double(double)>& depth_mm) { return straight(depth_mm, 6.0); };
  const auto reach = of([](double t) { return minimum_jerk(t - 1.0, 50.0, 3.0).y; });
  const auto trembling = of([](double t) { return minimum_jerk(t - 1.0, 50.0, 3.0).y + 0.5 * std::sin(25.0 * t); });
  EXPECT_GT(number(reach, "ldlj"), number(trembling, "ldlj") + 2.0);
  // A slow hand moves, too: version 1 knew nothing under 5 mm/s.
  EXPECT_TRUE(
      value(of([](double t) { return 20.0 + 4.5 * std::clamp(t - 1.0, 0.0, 4.0); }), "ldlj").value.has_value());
  EXPECT_EQ(value(of([](double t) { return 20.0 + 0.2 * std::sin(t); }), "ldlj").reason, "no_movement");
  EXPECT_FALSE(log_dimensionless_jerk(std::vector<glm::dvec3>(3, glm::dvec3(1.0)), 100.0).has_value());
}

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

TEST(Visibility, SharesAreOfTheTimeInTissue) {
  auto recording = straight([](double t) { return t < 2.0 ? -5.0 : 30.0; }, 10.0);
  for (auto& frame : recording.frames) {
    frame.needle_tip = frame.t_s >= 2.0 && frame.t_s < 4.0;  // 2 of 8 s in tissue
    frame.target = frame.t_s < 7.0;                          // 5 of 8 s
  }
  EXPECT_NEAR(number(recording, "vis_needle"), 0.25, 1e-9);
  EXPECT_NEAR(number(recording, "vis_target"), 0.625, 1e-9);
  EXPECT_NEAR(number(recording, "vis_joint"), 0.25, 1e-9);
  for (auto& frame : recording.frames) frame.live = frame.t_s < 6.0;  // a frozen picture shows nothing
  EXPECT_NEAR(number(recording, "vis_needle"), 0.25, 1e-9);
  EXPECT_NEAR(number(recording, "vis_target"), 0.5, 1e-9);
}

TEST(Visibility, FramesHoldUntilTheNextAtAnyRate) {
  auto recording = straight([](double) { return 30.0; }, 10.0);
  recording.frames = {
      {0.0, true, true, true, 1.0}, {2.503, true, false, true, 1.0}, {9.001, true, true, false, 1.0}};
  EXPECT_NEAR(number(recording, "vis_needle"), 0.2503 + 0.0999, 1e-9);
  EXPECT_NEAR(number(recording, "vis_target"), 0.9001, 1e-9);
  EXPECT_NEAR(number(recording, "vis_joint"), 0.2503, 1e-9);
}

TEST(Visibility, TooLittleTimeOutOfPlaneAndNoTargetAreNull) {
  EXPECT_EQ(value(straight([](double t) { return t < 2.0 ? -5.0 : 30.0; }, 2.9), "vis_needle").reason,
            "under_1_s_in_tissue");
  AttemptSetting s = setting();
  s.approach = cases::Approach::out_of_plane;
  const auto recording = straight([](double) { return 30.0; }, 5.0);
  EXPECT_EQ(value(recording, "vis_needle", s).reason, "not_meaningful_out_of_plane");
  EXPECT_EQ(value(recording, "vis_joint", s).reason, "not_meaningful_out_of_plane");
  EXPECT_TRUE(value(recording, "vis_target", s).value.has_value());
  s = setting();
  s.target.reset();
  EXPECT_EQ(value(recording, "vis_target", s).reason, "no_target");
  EXPECT_EQ(value(recording, "vis_joint", s).reason, "no_target");
}

TEST(Visibility, NearThePlaneIsOfUltrasoundThatWasRecordedSo) {
  auto recording = straight([](double) { return 30.0; }, 10.0);
  AttemptSetting s = setting();
  s.modality = cases::Modality::ultrasound;
  for (auto& frame : recording.frames)
    frame.near_plane = cases::NearPlane{frame.t_s < 2.0, frame.t_s >= 1.0, frame.t_s < 6.0, true};
  EXPECT_NEAR(number(recording, "vis_joint_2_mm", s), 0.1, 1e-9);
  EXPECT_NEAR(number(recording, "vis_joint_5_mm", s), 0.6, 1e-9);
  EXPECT_EQ(value(recording, "vis_joint_2_mm").reason, "not_ultrasound");
  EXPECT_FALSE(applies(value(recording, "vis_joint_2_mm"), manner_of(setting())));
  recording.frames[7].near_plane.reset();
  EXPECT_EQ(value(recording, "vis_joint_5_mm", s).reason, "near_plane_not_recorded");
  EXPECT_TRUE(applies(value(recording, "vis_joint_5_mm", s), manner_of(s)));
  s.approach = cases::Approach::out_of_plane;
  EXPECT_EQ(value(recording, "vis_joint_5_mm", s).reason, "not_meaningful_out_of_plane");
}

TEST(Visibility, TheNeedlesLengthIsAMeanOverTheTime) {
  auto recording = straight([](double t) { return t < 2.0 ? -5.0 : 30.0; }, 10.0);
  for (auto& frame : recording.frames) frame.needle_length_mm = frame.t_s < 4.0 ? 40.0 : 8.0;
  EXPECT_NEAR(number(recording, "visible_needle_length"), (2.0 * 40.0 + 6.0 * 8.0) / 8.0, 1e-9);
}

TEST(Visibility, OfTheSessionCountsWhatIsOutsideTissueToo) {
  auto recording = straight(in_turn({{5.0, -5.0}, {99.0, 30.0}}), 10.0);
  for (auto& frame : recording.frames) frame.target = frame.t_s < 7.0;
  EXPECT_NEAR(number(recording, "vis_joint_session"), 0.7, 1e-9);
  EXPECT_NEAR(number(recording, "vis_joint"), 0.4, 0.003);
  for (auto& frame : recording.frames) frame.needle_length_mm = frame.t_s < 6.0 ? 3.0 : 0.0;
  EXPECT_NEAR(number(recording, "vis_shaft"), 0.2, 0.004);
}

TEST(BlindAdvance, IsWhatNobodySaw) {
  // 10 mm/s from the skin: seen from 1 to 2 s, and by one picture at 4 s, which is no sight (in version 1 it was
  // one).
  auto recording = straight([](double t) { return 10.0 * t; }, 6.0);
  for (auto& frame : recording.frames)
    frame.needle_tip = (frame.t_s >= 1.0 && frame.t_s < 2.0) || std::abs(frame.t_s - 4.0) < 0.005;
  EXPECT_NEAR(number(recording, "blind_advance"), 50.0 - 0.1, 1e-6);
  EXPECT_NEAR(number(recording, "blind_advance_max"), 40.0 - 0.1, 1e-6);
  EXPECT_NEAR(number(recording, "advance_visible_share"), 10.1 / 60.0, 1e-6);
  for (auto& frame : recording.frames) frame.live = false;
  EXPECT_NEAR(number(recording, "blind_advance_max"), 60.0, 1e-6) << "a frozen picture shows nothing";
  EXPECT_EQ(number(straight([](double) { return 20.0; }, 3.0), "blind_advance"), 0.0);
  EXPECT_EQ(value(straight([](double) { return -20.0; }, 3.0), "blind_advance").reason, "never_in_tissue");
}

TEST(PlaneAngle, IsAveragedOverTheWay) {
  // In plane for 10 mm, then at 30° to it for 20 mm; a rest counts nothing.
  auto recording =
      straight([](double t) { return t < 1.0   ? 10.0 * t
                                     : t < 5.0 ? 10.0
                                               : 10.0 + 10.0 * (t - 5.0); }, 7.0);
  for (auto& pose : recording.poses) {
    pose.probe_axial = {0.0, 1.0, 0.0};
    pose.probe_lateral = pose.t_s < 3.0 ? glm::dvec3(1, 0, 0) : glm::dvec3(std::cos(0.3), 0.0, std::sin(0.3));
    if (pose.t_s > 3.0) pose.probe_axial = {0.0, std::cos(std::numbers::pi / 6), std::sin(std::numbers::pi / 6)};
    if (pose.t_s > 3.0) pose.probe_lateral = {1.0, 0.0, 0.0};
  }
  EXPECT_NEAR(number(recording, "plane_angle_mean"), 20.0, 1e-6);
  EXPECT_NEAR(number(recording, "plane_angle_max"), 30.0, 1e-6);
  for (auto& pose : recording.poses) pose.probe_lateral = pose.probe_axial;
  EXPECT_EQ(value(recording, "plane_angle_mean").reason, "no_picture_plane");
}

// 0 before: an angle of the guide's was praised as the trainee's.
TEST(PlaneAngle, UnderANeedleGuideIsTheGuides) {
  using enum cases::EventKind;
  auto recording = straight([](double t) { return ramp(t, 20.0); }, 3.0);  // in tissue from 1 s on
  for (auto& pose : recording.poses) pose.probe_axial = {0.0, 1.0, 0.0};
  for (const char* id : {"plane_angle_mean", "plane_angle_max", "probe_drift_advancing"}) {
    recording.events.reset();
    EXPECT_EQ(number(recording, id), 0.0) << "nobody listened: as before";
    recording.events = {{0.1, sign_in}};
    EXPECT_EQ(number(recording, id), 0.0) << "whether there was a guide is not known: as before";
    recording.events = {{0.001, needle_by_mouse}, {0.2, guide_on}, {0.5, guide_reached}, {0.9, guide_off}};
    EXPECT_EQ(number(recording, id), 0.0) << "in the air it led nothing";
    recording.events = {{0.001, needle_by_mouse}, {0.2, guide_on}, {0.5, guide_reached}, {1.1, guide_off}};
    EXPECT_EQ(value(recording, id).reason, "needle_guide_was_on");
    recording.events = {{0.001, needle_by_mouse}, {0.2, guide_on}, {0.5, guide_reached}};
    EXPECT_EQ(value(recording, id).reason, "needle_guide_was_on");
  }
  EXPECT_EQ(number(recording, "advance_visible_share"), 1.0) << "what was looked at stays the trainee's";
  EXPECT_EQ(number(recording, "blind_advance"), 0.0);
}

TEST(AdvanceBeyondPlane, CountsFromThreeMillimetresOnTheFarSide) {
  AttemptSetting s = setting();
  s.modality = cases::Modality::ultrasound;
  s.approach = cases::Approach::out_of_plane;
  auto recording = straight([](double t) { return 10.0 * t; }, 5.0);
  for (auto& pose : recording.poses) {  // the plane lies across the needle, 30 mm deep
    pose.probe_origin_lps_mm = {0.0, 30.0, 0.0};
    pose.probe_axial = {0.0, 0.0, 1.0};
    pose.probe_lateral = {1.0, 0.0, 0.0};
  }
  EXPECT_NEAR(number(recording, "advance_beyond_plane", s), 17.0, 1e-6);
  for (auto& pose : recording.poses) pose.probe_lateral = -pose.probe_lateral;
  EXPECT_NEAR(number(recording, "advance_beyond_plane", s), 17.0, 1e-6) << "a plane has no side of its own";
  EXPECT_EQ(value(recording, "advance_beyond_plane").reason, "not_meaningful_in_plane");
  EXPECT_EQ(value(recording, "blind_advance", s).reason, "not_meaningful_out_of_plane");
  EXPECT_EQ(value(recording, "probe_drift_advancing", s).reason, "not_meaningful_out_of_plane");
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

TEST(Times, InTissueAndFromPunctureToTrigger) {
  const auto recording = straight([](double t) { return ramp(t, 20.0); }, 5.0);
  EXPECT_NEAR(number(recording, "time_in_tissue"), 4.0, 0.011);
  EXPECT_NEAR(number(recording, "time_puncture_to_target"), 3.9, 0.011) << "from 2 mm of depth on";
  EXPECT_EQ(number(straight([](double) { return -9.0; }, 5.0), "time_in_tissue"), 0.0);
}

TEST(AdvanceVisibleShare, CountsWayNotTime) {
  // 20 mm seen, parked in view for long, 30 mm unseen.
  auto recording =
      straight([](double t) { return t < 2.0   ? 10.0 * t
                                     : t < 8.0 ? 20.0
                                               : 20.0 + 15.0 * (t - 8.0); }, 10.0);
  for (auto& frame : recording.frames) frame.needle_tip = frame.t_s < 8.0;
  EXPECT_NEAR(number(recording, "advance_visible_share"), 0.4, 1e-9);
  for (auto& frame : recording.frames) frame.live = frame.t_s < 1.0;
  EXPECT_NEAR(number(recording, "advance_visible_share"), 0.2, 1e-9) << "a frozen picture shows nothing";
}

TEST(AdvanceVisibleShare, WithdrawnWayCountsAgainAndJiggleDoesNot) {
  // Down 30, up 20, down 20, seen the second time only.
  auto recording = straight(
      [](double t) { return t < 3.0   ? 10.0 * t
                            : t < 5.0 ? 30.0 - 10.0 * (t - 3.0)
                                      : 10.0 + 10.0 * (t - 5.0); },
      7.0);
  for (auto& frame : recording.frames) frame.needle_tip = frame.t_s >= 5.0;
  EXPECT_NEAR(number(recording, "advance_visible_share"), 19.0 / 49.0, 1e-9) << "less 1 mm of play";
  auto still = straight([](double t) { return 30.0 + 0.49 * std::sin(40.0 * t); }, 7.0);
  EXPECT_EQ(value(still, "advance_visible_share").reason, "under_1_mm_of_advance");
  still.frames.clear();
  EXPECT_EQ(value(still, "advance_visible_share").reason, "no_picture");
  AttemptSetting s = setting();
  s.modality = cases::Modality::xray;
  EXPECT_EQ(value(recording, "advance_visible_share", s).reason, "not_meaningful_under_xray");
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
