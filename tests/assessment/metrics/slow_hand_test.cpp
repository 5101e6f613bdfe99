// What is slow is a way, too: path, detour and smoothness of hands that older versions did not see. "Before" is
// what the version before said.
#include "assessment/signals/smoothness.h"
#include "assessment/signals/way.h"
#include "tests/assessment/metrics/planted_attempts.h"

namespace seldinger::assessment {
namespace {

// From 20 mm above the skin straight to 40 mm below it.
cases::Recording at_speed(double mm_s) {
  return straight_down([=](double t_s) { return -20.0 + mm_s * t_s; }, 60.0 / mm_s);
}

TEST(SlowHand, AStraightWayIsItsLengthAtAnySpeed) {
  for (const double mm_s : {0.3, 1.0, 2.9, 3.0, 20.0, 150.0}) {
    const auto recording = at_speed(mm_s);
    // Before, at 2.9 mm/s and less: 0, 0 and −100 %.
    EXPECT_NEAR(planted_number(recording, "path_tip"), 60.0, 0.01) << mm_s;
    EXPECT_NEAR(planted_number(recording, "path_in_tissue"), 40.0, 0.01) << mm_s;
    EXPECT_NEAR(planted_number(recording, "path_inefficiency"), 0.0, 1e-9) << mm_s;
  }
}

TEST(SlowHand, NoiseAddsUnderAHundredth) {
  for (const double mm_s : {1.0, 2.9, 10.0, 30.0})
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
      auto recording = at_speed(mm_s);
      add_noise(recording, 0.05, seed);
      // Before, at 2.9 mm/s and less: 0.
      EXPECT_NEAR(planted_number(recording, "path_tip"), 60.0, 0.6) << mm_s << ", " << seed;
      const double detour = planted_number(recording, "path_inefficiency");
      EXPECT_GE(detour, -1e-9) << mm_s << ", " << seed;
      EXPECT_LT(detour, 1.0) << mm_s << ", " << seed;
    }
}

// Radius 5 mm, pitch 4 mm, three turns: 3·√((2π·5)² + 4²) mm.
TEST(SlowHand, AHelixIsItsClosedFormAtAnySpeed) {
  for (const double turn_s : {1.0, 4.0, 15.0, 60.0}) {
    const auto recording = recorded(
        [&](double t_s, cases::PoseSample& pose) {
          const double turns = t_s / turn_s, angle = 2.0 * std::numbers::pi * turns;
          pose.tip_lps_mm = {5.0 * std::cos(angle), 20.0 + 4.0 * turns, 5.0 * std::sin(angle)};
        },
        3.0 * turn_s);
    // Before, at 15 s a turn (2.1 mm/s) and more: 0.
    EXPECT_NEAR(planted_number(recording, "path_tip"), 95.00865203222506, 0.095) << turn_s;
  }
}

TEST(SlowHand, ASwingIsKeptToItsEnds) {
  // Ten times 6 mm to and fro: 120 mm of way.
  for (const double period_s : {1.0, 5.0}) {
    const auto recording =
        straight_down([&](double t_s) { return 30.0 + 3.0 * std::cos(2.0 * std::numbers::pi * t_s / period_s); },
                      10.0 * period_s);
    EXPECT_NEAR(planted_number(recording, "path_tip"), 120.0, 1.2) << period_s;  // before, of 5 s: 73
  }
}

TEST(SlowHand, WhatTremblesOnOneSpotGoesNowhere) {
  auto recording = straight_down([](double) { return 30.0; }, 60.0);
  add_noise(recording, 0.05, 4);
  EXPECT_LT(planted_number(recording, "path_tip"), 0.2);
  EXPECT_EQ(planted_value(recording, "ldlj").reason, "no_movement");
}

// In by 40 mm, then the hand rests while tissue slides past it by 6 mm to and fro.
TEST(SlowHand, BreathPastARestingHandIsNoWay) {
  const auto breath_mm = [](double t_s) { return 3.0 * std::sin(1.5 * t_s); };
  const auto waits = [&](double seconds) {
    return straight_down([](double t_s) { return std::min(40.0, 10.0 * t_s); }, 4.0 + seconds, breath_mm);
  };
  EXPECT_NEAR(planted_number(waits(60.0), "path_tip"), planted_number(waits(1.0), "path_tip"), 0.1);
  // The tissue has slid to 3 mm before it. Before: −7 %, of a way in the room and a straight line in the tissue.
  EXPECT_NEAR(planted_number(waits(3.33), "path_inefficiency"), 0.0, 1e-9);
  // A needle let go breathes with the patient: it goes nowhere.
  const auto rides = recorded(
      [&](double t_s, cases::PoseSample& pose) {
        pose.rest_tip_lps_mm = glm::dvec3(0.0, 30.0, 0.0);
        pose.tip_lps_mm = *pose.rest_tip_lps_mm + glm::dvec3(0.0, 0.0, breath_mm(t_s));
      },
      20.0);
  // Before: 42.5 mm.
  EXPECT_LT(planted_number(rides, "path_tip"), 0.1);
}

TEST(SlowHand, LengthIsOfLinesAndNeverUnderTheStraight) {
  EXPECT_EQ(length_mm(std::vector<glm::dvec3>{}), 0.0);
  EXPECT_EQ(length_mm(std::vector<glm::dvec3>{{1, 2, 3}}), 0.0);
  EXPECT_NEAR(length_mm(std::vector<glm::dvec3>{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}}), 3.0, 1e-12);
  EXPECT_NEAR(length_mm(std::vector<glm::dvec3>{{0, 0, 0}, {1, 0, 0}, {0, 0, 0}}), 2.0, 1e-12) << "a turn is kept";
  base::Rng rng(3);
  for (int k = 0; k < 50; ++k) {
    std::vector<glm::dvec3> points;
    for (int i = 0; i < 2 + k; ++i) points.push_back({rng.normal(), rng.normal(), 0.5 * i});
    EXPECT_GE(length_mm(points), glm::distance(points.front(), points.back()) - 1e-9);
  }
}

// SPARC of a minimum-jerk reach, by the authors' own code (github.com/siva82kb/SPARC) at 100 Hz.
constexpr double kReference = -1.4058293;

// A minimum-jerk reach.
double reached(double t_s, double seconds) {
  const double s = std::clamp(t_s / seconds, 0.0, 1.0);
  return s * s * s * (10.0 - 15.0 * s + 6.0 * s * s);
}

TEST(Smoothness, SparcOfAMinimumJerkSpeedIsTheReferencesAndOfNoLengthOrSize) {
  const auto speeds = [](double seconds, double mm) {
    std::vector<double> out;
    for (int i = 0; i < std::lround(seconds * 100.0); ++i) {
      const double s = i / (seconds * 100.0);
      out.push_back(mm / seconds * 30.0 * s * s * (1.0 - s) * (1.0 - s));
    }
    return out;
  };
  for (const double seconds : {1.0, 2.0, 4.0})
    for (const double mm : {1.0, 50.0})
      EXPECT_NEAR(*spectral_arc_length(speeds(seconds, mm), 100.0), kReference, 1e-6);
  EXPECT_FALSE(spectral_arc_length(std::vector<double>(3, 1.0), 100.0).has_value());
  EXPECT_FALSE(spectral_arc_length(std::vector<double>(50, 0.0), 100.0).has_value());
  // Two reaches with a stop between are less smooth than one.
  auto two = speeds(1.0, 25.0);
  const auto again = two;
  two.insert(two.end(), again.begin(), again.end());
  EXPECT_NEAR(*spectral_arc_length(two, 100.0), -2.2445455, 1e-6) << "by the same code";
}

TEST(Smoothness, OfASlowHandIsTold) {
  // 20 mm in 12 s: no faster than 3.2 mm/s.
  const auto slow = straight_down([](double t_s) { return 20.0 + 20.0 * reached(t_s - 1.0, 12.0); }, 14.0);
  // Before: ldlj no_movement_of_5_mm_s; there was no sparc.
  EXPECT_NEAR(planted_number(slow, "ldlj"), -5.3, 1.5);
  EXPECT_NEAR(planted_number(slow, "sparc"), kReference, 0.15);
  const auto fast = straight_down([](double t_s) { return 20.0 + 50.0 * reached(t_s - 1.0, 2.0); }, 4.0);
  EXPECT_NEAR(planted_number(fast, "sparc"), kReference, 0.1);
  // 30 mm at 5 mm/s, then at 10 mm/s: by ldlj a matter of how long they are (before: −18.2 and −15.9).
  const auto at = [](double mm_s) {
    return straight_down([=](double t_s) { return 20.0 + std::clamp(mm_s * (t_s - 1.0), 0.0, 30.0); },
                         2.0 + 30.0 / mm_s);
  };
  EXPECT_LT(std::abs(planted_number(at(5.0), "sparc") - planted_number(at(10.0), "sparc")), 1.0);
  const auto jerky = straight_down(
      [](double t_s) { return 20.0 + 50.0 * reached(t_s - 1.0, 3.0) + 0.5 * std::sin(25.0 * t_s); }, 5.0);
  EXPECT_LT(planted_number(jerky, "sparc"), planted_number(fast, "sparc") - 0.5);
}

// Two reaches with two seconds of rest between are two movements, one of them 5 mm/s throughout.
TEST(Smoothness, MovementsLieBetweenRests) {
  const auto recording = straight_down(
      [](double t_s) { return 10.0 + 20.0 * reached(t_s - 1.0, 1.0) + std::clamp(5.0 * (t_s - 4.0), 0.0, 10.0); },
      8.0);
  const auto signals = make_signals(planted_setting(), recording);
  ASSERT_TRUE(signals.has_value());
  const auto movements = movements_of(*signals);
  ASSERT_EQ(movements.size(), 2U);
  EXPECT_NEAR(movements[0].from_s, 1.0, 0.2);
  EXPECT_NEAR(movements[0].to_s, 2.0, 0.2);
  EXPECT_NEAR(movements[1].from_s, 4.0, 0.25);
  EXPECT_NEAR(movements[1].to_s, 6.0, 0.25);
}

}  // namespace
}  // namespace seldinger::assessment
