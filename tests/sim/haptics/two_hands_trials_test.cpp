// Trials of sim/haptics/two_hands: both tools in space, with limiter and all, under simulated hands on simulated
// devices; and hands that do anything (S2, S10-S12, S16 of docs/touch.md).
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "app/measure/rigs/settling.h"
#include "sim/base/rng.h"
#include "sim/base/vectors.h"
#include "tests/sim/haptics/bodies.h"

namespace seldinger::haptics {
namespace {

using measure::settle;
using measure::Settling;
using measure::Trial;

struct Situation {
  const char* name;
  Tool tool;
  double x_mm, to_mm, back_mm, push_n;
};

constexpr Situation kSituations[] = {
    {"needle dents the skin", Tool::needle, 0.0, 6.0, 0.0, 1.0},
    {"needle in muscle", Tool::needle, 0.0, 25.0, 0.0, 0.5},
    {"needle pulled back", Tool::needle, 0.0, 25.0, 5.0, -0.2},
    {"needle on a rib", Tool::needle, 40.0, 10.0, 0.0, 1.0},
    {"probe on soft skin", Tool::probe, -20.0, 6.0, 0.0, 1.0},
    {"probe over a rib", Tool::probe, 40.0, 3.0, 0.0, 1.0},
    {"finger on the skin", Tool::finger, 0.0, 2.0, 0.0, 1.0},
    {"pointer on a rib", Tool::pointer, 40.0, 8.0, 0.0, 1.0},
};

TEST(TwoHandsTrials, EveryToolComesToRestInSpaceToo) {
  for (const Situation& situation : kSituations)
    for (const Hand& hand : hands())
      for (int delay = 0; delay <= kMostDelayTicks; ++delay) {
        ArmModel device = *find_arm_model("omni");
        device.delay_ticks = delay;
        const TwoHands two(flat_body(), two_omnis());
        HandStates states{};
        Trial trial{device, hand};
        trial.from_mm = -10.0;  // half a second outside, in which force is let in
        trial.to_mm = situation.to_mm;
        trial.back_mm = situation.back_mm;
        trial.push_n = situation.push_n;
        const Settling settling = settle(trial, [&](double depth_mm) {
          HandInput input = holding(situation.tool, {situation.x_mm, 0.0, -depth_mm});
          input.delay_ticks = delay;
          return two.advance({HandInput{}, input}, kTickS, states)[1].motor_n.z;
        });
        EXPECT_TRUE(settling.settled(device))
            << situation.name << ", " << hand.name << ", " << delay << " ms: " << settling.position_mm << " mm, "
            << settling.force_n << " N";
        EXPECT_GE(settling.least_work_mj, -1.0) << situation.name << ", " << hand.name << ", " << delay;
      }
}

// One hand's random day: it wanders, turns, jumps, swaps, falls silent, comes late.
struct Wanderer {
  explicit Wanderer(std::uint64_t seed) : rng(seed) {}

  HandInput next() {
    const double event = rng.uniform();
    if (event < 0.002) input.tool = static_cast<Tool>(rng.bits() % kTools);
    if (event > 0.999) input.delay_ticks = static_cast<int>(rng.bits() % 4);
    if (event > 0.5 && event < 0.501) to_lps_mm = place();
    if (event > 0.6 && event < 0.6003) input.pose.position_lps_mm = place();  // a teleport
    if (event > 0.7 && event < 0.702) silent = static_cast<int>(rng.bits() % 40);
    const glm::dvec3 way = to_lps_mm - input.pose.position_lps_mm;
    const double far_mm = glm::length(way);
    if (far_mm > 0.2)
      input.pose.position_lps_mm += 0.2 / far_mm * way;  // 200 mm/s
    else
      to_lps_mm = place();
    input.pose.axis = glm::normalize(input.pose.axis + 0.01 * (turn() + 0.3 * (kDown - input.pose.axis)));
    HandInput said = input;
    said.healthy = silent == 0;
    if (silent > 0) --silent;
    if (event > 0.8 && event < 0.8005) said.pose.position_lps_mm.x = std::numeric_limits<double>::quiet_NaN();
    if (event > 0.9 && event < 0.9005) said.pose.axis = glm::dvec3(0.0);
    return said;
  }
  glm::dvec3 place() {
    return {-50.0 + 100.0 * rng.uniform(), -50.0 + 100.0 * rng.uniform(), 20.0 - 90.0 * rng.uniform()};
  }
  glm::dvec3 turn() { return {rng.normal(), rng.normal(), rng.normal()}; }

  base::Rng rng;
  HandInput input = holding(Tool::needle, {0.0, 0.0, 20.0});
  glm::dvec3 to_lps_mm{0.0, 0.0, -30.0};
  int silent = 0;
};

TEST(TwoHandsTrials, WhateverHandsDoForceIsBoundedAndChangesSlowly) {
  const cases::Case body = bumpy_body(false);
  const TwoHands two(body, two_omnis());
  HandStates states{};
  HandForces last{};
  Wanderer left(1), right(2);
  base::Rng clock(3);
  int felt = 0, ruptures = 0, faults = 0;
  for (int tick = 0; tick < 60000; ++tick) {
    const double elapsed_s = clock.uniform() < 0.002 ? 0.03 * clock.uniform() : kTickS;
    const HandInputs inputs{left.next(), right.next()};
    const HandForces forces = two.advance(inputs, elapsed_s, states);
    for (std::size_t side = 0; side < 2; ++side) {
      const ForceLimiterState& limiter = states[side].limiter;
      ASSERT_TRUE(base::is_finite(forces[side].motor_n)) << tick;
      EXPECT_LE(glm::length(forces[side].motor_n), 3.3 + 1e-9) << tick;
      const double step_n = glm::distance(forces[side].motor_n, last[side].motor_n);
      if (limiter.fault_s > 0.0) {
        ++faults;
        EXPECT_LE(glm::length(forces[side].motor_n), glm::length(last[side].motor_n) + 1e-9) << tick;
        if (limiter.fault_s >= 0.020) {
          EXPECT_EQ(glm::length(forces[side].motor_n), 0.0) << tick;
        }
      } else {
        EXPECT_LE(step_n, 0.15 + 1e-9) << tick;
      }
      felt += glm::length(forces[side].motor_n) > 0.1 ? 1 : 0;
      ruptures += forces[side].ruptured ? 1 : 0;
    }
    last = forces;
  }
  EXPECT_GT(felt, 10000);
  EXPECT_GT(ruptures, 10);
  EXPECT_GT(faults, 1000);
}

}  // namespace
}  // namespace seldinger::haptics
