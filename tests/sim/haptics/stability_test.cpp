// Tests that a hand, a device and our law come to rest, and that these tests could see it when they did not: S1-S3,
// S11's needle part, S14 of docs/touch.md.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "app/measure/rigs/needle_trials.h"
#include "app/measure/rigs/probe_trials.h"
#include "app/measure/rigs/thesis_needle.h"
#include "app/measure/rigs/wall.h"
#include "app/measure/rigs/wall_map.h"

namespace seldinger::haptics {
namespace {

using measure::drive_needle;
using measure::drive_thesis;
using measure::kMapDampingNSMm;
using measure::kMapStiffnessNMm;
using measure::needle_situations;
using measure::NeedleSituation;
using measure::probe_situations;
using measure::ProbeSituation;
using measure::settle;
using measure::settle_needle;
using measure::settle_probe;
using measure::Settling;
using measure::ThesisNeedle;
using measure::Trial;
using measure::Wall;
using measure::wall_map;
using measure::WallCell;

using volume::TissueClass;

std::string told(const ArmModel& device, const Hand& hand, const NeedleSituation& situation) {
  return std::string(device.name) + ", friction " + std::to_string(device.coulomb_n) + " N, delay " +
         std::to_string(device.delay_ticks) + " ms, hand " + hand.name + ": " + situation.name;
}

// The stiffest linear wall whose oscillation does not grow, found by trial: pushed on by 1 N, given 1 mm/s.
double stiffest_wall_n_mm(const ArmModel& device, double damping_n_s_mm) {
  double low = 0.01, high = 20.0;
  for (int i = 0; i < 12; ++i) {
    const double stiffness = std::sqrt(low * high);
    Wall wall(stiffness, damping_n_s_mm, 0.0);
    Trial trial{device, *find_hand("none")};
    trial.to_mm = 1.0 / stiffness;
    trial.speed_mm_s = 1.0;
    trial.seconds = 4.0;
    const Settling settling = settle(trial, [&](double depth_mm) { return wall.advance(depth_mm); });
    const double undamped_mm = 2.0 * std::sqrt(device.mass_kg / (1000.0 * stiffness));
    (settling.position_mm < undamped_mm ? low : high) = stiffness;
  }
  return low;
}

// S2: the bench against theory, two independent ways to the same number.
TEST(Stability, TheRigFindsTheBoundOfTheory) {
  for (const double mass_kg : {0.045, 0.25})
    for (const double damping : {0.0005, 0.001})
      for (int delay = 0; delay <= kMostDelayTicks; ++delay) {
        const ArmModel device{"linear", mass_kg, 5e-6, 0.0, 0.0, 100.0, 100.0, delay, ""};
        const double bound = (device.damping_n_s_mm + damping) / (0.0005 + 0.001 * delay);
        EXPECT_NEAR(stiffest_wall_n_mm(device, damping) / bound, 1.0, 0.05)
            << mass_kg << " kg, " << damping << " N s/mm, delay " << delay;
      }
}

// S1
TEST(Stability, AWallGivesNoEnergyAndOneOfTheWrongSignDoes) {
  ArmModel device = *find_arm_model("premium");
  for (const Hand& hand : hands())
    for (const double sign : {1.0, -1.0}) {
      Wall wall(0.5, 0.001 * sign, 100.0);
      Trial trial{device, hand};
      trial.to_mm = 2.0;
      trial.speed_mm_s = 100.0;
      const Settling settling = settle(trial, [&](double depth_mm) { return wall.advance(depth_mm); });
      if (sign > 0.0) {
        EXPECT_TRUE(settling.settled(device)) << hand.name;
        EXPECT_GE(settling.least_work_mj, -1.0) << hand.name;
      } else if (hand.stiffness_n_mm == 0.0) {
        EXPECT_FALSE(settling.settled(device)) << hand.name;
      }
    }
}

void expect_rest(const ArmModel& device) {
  for (const Hand& hand : hands())
    for (const NeedleSituation& situation : needle_situations()) {
      const Settling settling = settle_needle(situation, device, hand);
      EXPECT_TRUE(settling.settled(device))
          << told(device, hand, situation) << ": " << settling.position_mm << " mm, " << settling.force_n << " N";
      EXPECT_GE(settling.least_work_mj, -1.0) << told(device, hand, situation);
      EXPECT_LE(settling.most_step_n, 0.15) << told(device, hand, situation);
    }
}

// S11: from skin to rib under the probe, and along the skin.
void expect_probe_rests(const ArmModel& device) {
  for (const Hand& hand : hands())
    for (const ProbeSituation& situation : probe_situations()) {
      const Settling settling = settle_probe(situation, device, hand);
      const std::string told = std::string(situation.name) + ", " + device.name + ", hand " + hand.name +
                               ", delay " + std::to_string(device.delay_ticks);
      EXPECT_TRUE(settling.settled(device)) << told << ": " << settling.position_mm << " mm";
      EXPECT_GE(settling.least_work_mj, -1.0) << told;
      EXPECT_LE(settling.most_step_n, 0.15) << told;
    }
}

TEST(Stability, TheProbeComesToRestUnderAnyHand) {
  for (ArmModel device : arm_models()) {
    device.coulomb_n = 0.02;
    for (device.delay_ticks = 0; device.delay_ticks <= kMostDelayTicks; ++device.delay_ticks) {
      expect_probe_rests(device);
      for (const ProbeSituation& situation : probe_situations()) {
        EXPECT_TRUE(settle_probe(situation, device, *find_hand("none"), kStiffnessMargin).settled(device))
            << situation.name << ", " << device.name << ", delay " << device.delay_ticks << ", at the margin";
        if (device.delay_ticks > 0 && !situation.sideways) {
          EXPECT_FALSE(settle_probe(situation, device, *find_hand("none"), 1.0, 0.0).settled(device))
              << situation.name << ": a damper that is missing is seen";
        }
      }
    }
  }
}

// No limit cycle with any hand: every device as it is, and at every delay with next to no dry friction.
TEST(Stability, TheNeedleComesToRestUnderAnyHand) {
  for (ArmModel device : arm_models()) {
    expect_rest(device);
    device.coulomb_n = 0.02;
    for (device.delay_ticks = 0; device.delay_ticks <= kMostDelayTicks; ++device.delay_ticks) expect_rest(device);
  }
}

// S2: the law as shipped keeps its margin, not only the formula.
TEST(Stability, TheNeedleRestsAtItsMarginTimesTheStiffness) {
  for (ArmModel device : arm_models()) {
    device.coulomb_n = 0.02;
    for (device.delay_ticks = 0; device.delay_ticks <= kMostDelayTicks; ++device.delay_ticks)
      for (const NeedleSituation& situation : needle_situations())
        EXPECT_TRUE(settle_needle(situation, device, *find_hand("none"), kStiffnessMargin).settled(device))
            << told(device, *find_hand("none"), situation);
  }
}

struct Mutant {
  double stiffness = 1.0, damping = 1.0, sign = 1.0;
};

// How many situations a changed law does not rest in, on the device with the least friction, under no hand.
int restless(const Mutant& mutant) {
  ArmModel device = *find_arm_model("premium");
  device.coulomb_n = 0.02;
  int count = 0;
  for (const NeedleSituation& situation : needle_situations()) {
    NeedleSettings settings = needle_settings(device);
    settings.stiffness_n_mm *= mutant.stiffness;
    settings.damping_n_s_mm *= mutant.damping;
    const NeedleLaw law(settings);
    NeedleTrack track;
    Trial trial{device, *find_hand("none")};
    trial.to_mm = situation.to_mm;
    trial.back_mm = situation.back_mm;
    trial.speed_mm_s = situation.speed_mm_s;
    const Settling settling = settle(trial, [&](double depth_mm) {
      const NeedleForce force = law.advance(situation.path, depth_mm, track);
      return force.axial_n + (mutant.sign - 1.0) * force.damper_n;
    });
    if (!settling.settled(device)) ++count;
  }
  return count;
}

// The mutation test: a flipped damper, none, and too stiff a wall are seen.
TEST(Stability, FaultsPutInOnPurposeAreSeen) {
  const int all = static_cast<int>(needle_situations().size());
  EXPECT_EQ(restless({}), 0);
  EXPECT_EQ(restless({.sign = -1.0}), all) << "damper of the wrong sign";
  EXPECT_GE(restless({.damping = 0.0}), all / 2) << "no damper";
  EXPECT_GE(restless({.stiffness = 4.0}), 1) << "bone at nearly three times the bound";
}

// S3 with a hand
TEST(Stability, ASlowHandFeelsASmoothPlateau) {
  for (const ArmModel& device : arm_models()) {
    const NeedleLayer kidney{0.0, needle_tissue(TissueClass::kidney)};
    const NeedleLaw law(needle_settings(device));
    NeedleTrack track;
    Trial trial{device, *find_hand("medium")};
    trial.device.encoder_mm = 0.055;
    trial.to_mm = 20.0;
    trial.push_n = 0.0;
    trial.drive_mm_s = 0.5;
    trial.seconds = 24.0;
    trial.watched_s = 8.0;
    const Settling settling = settle(trial, [&](double depth_mm) {
      return law.advance({&kidney, 1}, depth_mm, track).axial_n;
    });
    EXPECT_GT(settling.position_mm, 3.0) << device.name << ": it moves on";
    EXPECT_LE(settling.unrest_n, 0.03) << device.name;
  }
}

TEST(Stability, AtTheThesisSpeedOurForceIsQuietAndTheThesisLawIsNot) {
  const ArmModel& omni = *find_arm_model("omni");
  for (const Hand& hand : hands()) {
    if (hand.stiffness_n_mm == 0.0) continue;
    EXPECT_LE(drive_needle(omni, hand).unrest_n, 0.05) << hand.name;
    for (const int m : {1, 10, 50}) EXPECT_GE(drive_thesis(omni, hand, m).unrest_n, 0.5) << hand.name << " m " << m;
  }
}

TEST(Stability, TheThesisLawDependsOnSpeedAndIsZeroAtRest) {
  for (const double speed : {1.0, 500.0 / 60.0, 100.0}) {
    ThesisNeedle law(1.53, 10);
    double force = 0.0;
    for (int i = 0; i < 100; ++i) force = law.advance(0.001 * speed * i);
    EXPECT_NEAR(force, 1.53 * speed / (500.0 / 60.0), 1e-9);
    for (int i = 0; i < 10; ++i) force = law.advance(0.001 * speed * 99);
    EXPECT_NEAR(force, 0.0, 1e-12);
  }
}

// S14: a capsule opened by a hand that then stays where it is. The needle goes on by what the hand's spring gives
// way, at most twice (an undamped swing), and meets nothing to open again.
TEST(Stability, ARuptureKicksNoFurtherThanTheHandsSpring) {
  for (const char* name : {"fingertip", "light", "medium", "firm"})
    for (const ArmModel& device : arm_models()) {
      const Hand& hand = *find_hand(name);
      const NeedleLayer kidney{0.0, needle_tissue(TissueClass::kidney)};
      const NeedleLaw law(needle_settings(device));
      NeedleTrack track;
      HandRig bench(device, hand, 0.0, 0.0);
      double grip_mm = 0.0, opened_mm = -1.0, furthest_mm = 0.0;
      int ruptures = 0;
      for (int i = 0; i < 12000; ++i) {
        const NeedleForce force = law.advance({&kidney, 1}, bench.encoder_mm(), track);
        if (force.ruptured) {
          ++ruptures;
          opened_mm = bench.at_mm();
        }
        const double speed = ruptures == 0 ? 8.0 : 0.0;
        bench.hold(force.axial_n, {grip_mm, speed, 0.0});
        grip_mm += 0.001 * speed;
        if (ruptures > 0) furthest_mm = std::max(furthest_mm, bench.at_mm() - opened_mm);
      }
      EXPECT_EQ(ruptures, 1) << name << " on " << device.name;
      EXPECT_GT(furthest_mm, 0.0);
      // From the capsule's force to the plateau's foot; friction of the device only helps.
      EXPECT_LE(furthest_mm, 2.0 * (2.6 - 1.53) / hand.stiffness_n_mm + 0.5) << name << " on " << device.name;
    }
}

TEST(WallMap, ShowsTheRuleHoldAtOurDampingAndCyclesAboveIt) {
  ArmModel device = *find_arm_model("omni");
  device.coulomb_n = 0.02;
  const auto map = wall_map(device, *find_hand("none"));
  ASSERT_EQ(map.size(), 4 * std::size(kMapDampingNSMm) * std::size(kMapStiffnessNMm));
  int held = 0, cycling = 0;
  for (const WallCell& cell : map) {
    if (cell.damping_n_s_mm == kWallDampingNSMm && cell.stiffness_n_mm <= cell.bound_n_mm / kStiffnessMargin) {
      EXPECT_TRUE(cell.settles) << cell.stiffness_n_mm << " N/mm, delay " << cell.delay_ticks;
      ++held;
    }
    if (cell.stiffness_n_mm > 1.5 * cell.bound_n_mm) {
      EXPECT_FALSE(cell.settles) << cell.stiffness_n_mm << " N/mm, " << cell.damping_n_s_mm << ", delay "
                                 << cell.delay_ticks;
      ++cycling;
    }
  }
  EXPECT_GE(held, 14);
  EXPECT_GE(cycling, 100);
}

}  // namespace
}  // namespace seldinger::haptics
