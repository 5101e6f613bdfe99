// Tests of sim/haptics/force_limiter: S16 and S17 of docs/touch.md.
#include "sim/haptics/force_limiter.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "app/measure/rigs/needle_trials.h"
#include "tests/fixtures/allocations.h"

namespace seldinger::haptics {
namespace {

using measure::needle_situations;
using measure::NeedleSituation;
using measure::settle;
using measure::Settling;
using measure::Trial;

constexpr ForceLimits kOmni{3.3, 0.88};
constexpr double kTick = 0.001;

glm::dvec3 settled(const ForceLimiter& limiter, const glm::dvec3& wanted, ForceLimiterState& state,
                   int ticks = 1000) {
  for (int i = 0; i < ticks; ++i) limiter.advance(wanted, kTick, true, state);
  return state.out_n;
}

TEST(ForceLimiter, PassesWhatADeviceCanDo) {
  const ForceLimiter limiter(kOmni);
  ForceLimiterState state;
  EXPECT_LE(glm::length(limiter.advance({0.5, -0.5, 0.2}, kTick, true, state)), 0.02) << "it comes in slowly";
  const glm::dvec3 out = settled(limiter, {0.5, -0.5, 0.2}, state);
  EXPECT_NEAR(glm::distance(out, {0.5, -0.5, 0.2}), 0.0, 1e-12);
  EXPECT_EQ(state.held_back_n, 0.0);
}

TEST(ForceLimiter, KeepsPeakAndDirection) {
  const ForceLimiter limiter(kOmni);
  ForceLimiterState state;
  double most = 0.0;
  for (int i = 0; i < 2000; ++i)
    most = std::max(most, glm::length(limiter.advance({30.0, 40.0, 0.0}, kTick, true, state)));
  EXPECT_LE(most, 3.3 + 1e-12);
  EXPECT_GT(most, 3.0) << "and gives it while it is cold";
  EXPECT_NEAR(state.out_n.x / state.out_n.y, 0.75, 1e-9);
  EXPECT_NEAR(state.held_back_n, 50.0 - 3.3, 1e-9) << "what is not felt is told";
  limiter.advance({3.0, 4.0, 0.0}, kTick, false, state);
  EXPECT_EQ(state.held_back_n, 0.0) << "a fault is another matter";
}

// S17
TEST(ForceLimiter, OverTimeNoMoreThanTheMotorsBear) {
  const ForceLimiter limiter(kOmni);
  ForceLimiterState state;
  settled(limiter, {0.88, 0.0, 0.0}, state, 600000);
  EXPECT_NEAR(state.out_n.x, 0.88, 1e-9) << "for ever is for ever";
  state = {};
  settled(limiter, {2.6, 0.0, 0.0}, state, 5000);
  EXPECT_NEAR(state.out_n.x, 2.6, 1e-9) << "five seconds before a kidney's capsule are nothing";
  state = {};
  settled(limiter, {3.3, 0.0, 0.0}, state);
  double last = state.out_n.x, squares = 0.0;
  for (int i = 0; i < 600000; ++i) {
    const double out = limiter.advance({3.3, 0.0, 0.0}, kTick, true, state).x;
    EXPECT_LE(out, last + 1e-9) << "less and less";
    EXPECT_LE(last - out, 0.005) << "and smoothly";
    last = out;
    if (i >= 300000) squares += out * out;
  }
  EXPECT_NEAR(last, 0.88, 0.02);
  EXPECT_LE(std::sqrt(squares / 300000.0), 0.88 * 1.02);
  settled(limiter, {0.0, 0.0, 0.0}, state, 120000);
  settled(limiter, {3.3, 0.0, 0.0}, state, 500);
  EXPECT_GT(state.out_n.x, 3.0) << "after a rest all is there again";
}

// S16: a device that stops answering, and answers again.
TEST(ForceLimiter, AFaultTakesAllForceIn20MsAndItComesBackWithoutAJump) {
  const ForceLimiter limiter(kOmni);
  for (const double wanted : {0.8, -2.0, 3.3}) {
    ForceLimiterState state;
    settled(limiter, {wanted, 0.0, 0.0}, state);
    double last = std::abs(state.out_n.x);
    for (int i = 1; i <= 30; ++i) {
      const double out = std::abs(limiter.advance({wanted, 0.0, 0.0}, kTick, false, state).x);
      EXPECT_LE(out, last);
      if (i >= 20) {
        EXPECT_NEAR(out, 0.0, 1e-12) << i;
      }
      last = out;
    }
    for (int i = 0; i < 1000; ++i) {
      const double out = std::abs(limiter.advance({wanted, 0.0, 0.0}, kTick, true, state).x);
      EXPECT_LE(std::abs(out - last), 0.02) << i;
      last = out;
    }
    EXPECT_NEAR(last, std::abs(wanted), 0.3);
  }
}

// A fault that is over before all is gone goes on from where it is.
TEST(ForceLimiter, AShortFaultIsNoJumpEither) {
  const ForceLimiter limiter(kOmni);
  for (int bad = 1; bad <= 25; ++bad) {
    ForceLimiterState state;
    double last = settled(limiter, {3.0, 0.0, 0.0}, state).x;
    for (int i = 0; i < 1000; ++i) {
      const double out = limiter.advance({3.0, 0.0, 0.0}, kTick, i >= bad, state).x;
      EXPECT_LE(std::abs(out - last), 0.17) << bad << " " << i;
      last = out;
    }
    EXPECT_NEAR(last, 3.0, 0.3);
  }
}

// S16: ticks that are missed, while the hand moves on; and a stall longer than force may stand unwatched.
TEST(ForceLimiter, MissedTicksAreNoJump) {
  const ForceLimiter limiter(kOmni);
  for (int missed = 1; missed < 20; ++missed) {
    ForceLimiterState state;
    double last = settled(limiter, {0.5, 0.0, 0.0}, state).x;
    double out = limiter.advance({2.5, 0.0, 0.0}, kTick * missed, true, state).x;
    EXPECT_LE(std::abs(out - last), 0.15 + 1e-12) << missed;
    for (int i = 0; i < 100; ++i) {
      last = out;
      out = limiter.advance({2.5, 0.0, 0.0}, kTick, true, state).x;
      EXPECT_LE(std::abs(out - last), 0.15 + 1e-12) << missed;
    }
    EXPECT_NEAR(out, 2.5, 0.01) << "and it is there again";
  }
  ForceLimiterState state;
  settled(limiter, {2.5, 0.0, 0.0}, state);
  EXPECT_EQ(limiter.advance({2.5, 0.0, 0.0}, 0.030, true, state).x, 0.0);
  EXPECT_LE(limiter.advance({2.5, 0.0, 0.0}, kTick, true, state).x, 0.02);
}

TEST(ForceLimiter, WhatIsNoNumberIsAFaultAndLeavesNoTrace) {
  const ForceLimiter limiter(kOmni);
  ForceLimiterState state;
  settled(limiter, {1.0, 0.0, 0.0}, state);
  const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
  for (const glm::dvec3& wanted : {glm::dvec3(nan, 0, 0), glm::dvec3(0, -inf, 0)})
    for (int i = 0; i < 10; ++i) EXPECT_LE(glm::length(limiter.advance(wanted, kTick, true, state)), 1.0);
  EXPECT_LE(glm::length(limiter.advance({1.0, 0.0, 0.0}, nan, true, state)), 1.0) << "nor is a time that is none";
  EXPECT_NEAR(settled(limiter, {1.0, 0.0, 0.0}, state).x, 1.0, 0.01);
}

// In the loop of hand and device it changes nothing about rest.
TEST(ForceLimiter, TheNeedleRestsBehindIt) {
  for (ArmModel device : arm_models()) {
    device.coulomb_n = 0.02;
    for (const Hand& hand : hands())
      for (const NeedleSituation& situation : needle_situations()) {
        const NeedleLaw law(needle_settings(device));
        const ForceLimiter limiter({device.peak_n, device.continuous_n});
        NeedleTrack track;
        ForceLimiterState state;
        Trial trial{device, hand};
        trial.to_mm = situation.to_mm;
        trial.back_mm = situation.back_mm;
        trial.speed_mm_s = situation.speed_mm_s;
        trial.push_n = 0.5;
        const Settling settling = settle(trial, [&](double depth_mm) {
          return limiter.advance({law.advance(situation.path, depth_mm, track).axial_n, 0, 0}, kTick, true, state)
              .x;
        });
        // The force may still follow the motors' warmth; the hand is still.
        EXPECT_LE(settling.force_n, 0.1) << device.name << " " << hand.name << " " << situation.name;
        EXPECT_LE(settling.most_step_n, 0.15 + 1e-12);
      }
  }
}

TEST(ForceLimiter, AllocatesNothing) {
  const ForceLimiter limiter(kOmni);
  ForceLimiterState state;
  const long before = fixtures::allocations();
  settled(limiter, {1.0, 2.0, 3.0}, state);
  EXPECT_EQ(fixtures::allocations(), before);
}

}  // namespace
}  // namespace seldinger::haptics
