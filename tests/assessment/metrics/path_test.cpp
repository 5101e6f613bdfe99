// How long, how straight and how smooth the way of the tip was: closed forms and edge rules.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "assessment/signals/motion.h"
#include "assessment/signals/smoothness.h"
#include "sim/base/rng.h"
#include "tests/assessment/metrics/straight_attempts.h"

namespace seldinger::assessment {
namespace {

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

}  // namespace
}  // namespace seldinger::assessment
