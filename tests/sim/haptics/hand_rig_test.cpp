// Tests of sim/haptics/hand_rig against closed forms of a mass under forces.
#include "sim/haptics/hand_rig.h"

#include <gtest/gtest.h>

#include <cmath>

namespace seldinger::haptics {
namespace {

// No friction, no quantiser, no delay.
ArmModel plain(double mass_kg) {
  return {"plain", mass_kg, 0.0, 0.0, 0.0, 100.0, 100.0, 0, "test"};
}

const Hand kNone = *find_hand("none");

TEST(HandRig, AConstantPushAcceleratesByNewton) {
  HandRig bench(plain(0.05), kNone, 1.0, 2.0);
  for (int i = 0; i < 100; ++i) bench.hold(0.5, {0.0, 0.0, 2.0});
  const double acceleration = 1000.0 * 1.5 / 0.05;  // mm/s²
  EXPECT_NEAR(bench.speed_mm_s(), 2.0 + acceleration * 0.1, 1e-6);
  EXPECT_NEAR(bench.at_mm(), 1.0 + 0.2 + 0.5 * acceleration * 0.01, 0.02);
  EXPECT_NEAR(bench.work_mj(), 0.5 * (bench.at_mm() - 1.0), 1e-9);
}

TEST(HandRig, ViscousFrictionSettlesAtItsSpeed) {
  ArmModel device = plain(0.05);
  device.damping_n_s_mm = 0.005;  // 5 N s/m: a time constant of 10 ms
  HandRig bench(device, kNone, 0.0, 0.0);
  for (int i = 0; i < 10; ++i) bench.hold(0.0, {0.0, 0.0, 1.0});
  EXPECT_NEAR(bench.speed_mm_s(), 200.0 * (1.0 - std::exp(-1.0)), 0.2);
  for (int i = 0; i < 200; ++i) bench.hold(0.0, {0.0, 0.0, 1.0});
  EXPECT_NEAR(bench.speed_mm_s(), 200.0, 1e-3);
}

TEST(HandRig, DryFrictionStopsAndHolds) {
  ArmModel device = plain(0.045);
  device.coulomb_n = 0.26;
  HandRig sliding(device, kNone, 0.0, 100.0);
  for (int i = 0; i < 100; ++i) sliding.hold(0.0, {});
  EXPECT_EQ(sliding.speed_mm_s(), 0.0);
  // m v² / 2 = F s; in kg, mm/s, N, mm there is a factor of 1000.
  EXPECT_NEAR(sliding.at_mm(), 0.045 * 100.0 * 100.0 / (2.0 * 0.26 * 1000.0), 0.002);
  HandRig held(device, kNone, 0.0, 0.0);
  for (int i = 0; i < 100; ++i) held.hold(0.0, {0.0, 0.0, 0.259});
  EXPECT_EQ(held.at_mm(), 0.0);
  for (int i = 0; i < 100; ++i) held.hold(0.0, {0.0, 0.0, 0.261});
  EXPECT_GT(held.at_mm(), 0.0);
}

TEST(HandRig, AGripIsASpringWithTheHandsMass) {
  const Hand hand{"test", 0.15, 0.0, 0.3, ""};
  HandRig bench(plain(0.045), hand, 5.0, 0.0);
  const double period_s = 2.0 * 3.141592653589793 * std::sqrt(0.195 / 300.0);
  int crossings = 0;
  double last = 5.0, first_s = 0.0, latest_s = 0.0;
  for (int i = 1; i <= 2000; ++i) {
    bench.hold(0.0, {0.0, 0.0, 0.0});
    if (last > 0.0 && bench.at_mm() <= 0.0) {
      latest_s = 0.001 * (i - 1 + last / (last - bench.at_mm()));
      if (crossings++ == 0) first_s = latest_s;
    }
    last = bench.at_mm();
  }
  ASSERT_GT(crossings, 5);
  EXPECT_NEAR((latest_s - first_s) / (crossings - 1), period_s, 0.001 * period_s);
}

TEST(HandRig, AGripFollowsWhereTheHandGoes) {
  HandRig bench(plain(0.045), *find_hand("firm"), 0.0, 0.0);
  for (int i = 0; i < 2000; ++i) bench.hold(0.0, {0.01 * i, 10.0, 0.0});
  EXPECT_NEAR(bench.at_mm(), 20.0, 0.05);
  EXPECT_NEAR(bench.speed_mm_s(), 10.0, 0.1);
}

TEST(HandRig, ForcesComeLateAndLimited) {
  for (int delay = 0; delay <= kMostDelayTicks; ++delay) {
    ArmModel device = plain(0.05);
    device.peak_n = 3.3;
    device.delay_ticks = delay;
    HandRig bench(device, kNone, 0.0, 0.0, -1.0);
    for (int tick = 0; tick <= delay; ++tick) {
      EXPECT_EQ(bench.motor_n(), -1.0) << "what was in the line, tick " << tick;
      bench.hold(5.0 + tick, {});
    }
    EXPECT_EQ(bench.motor_n(), 3.3);
    for (int tick = 0; tick <= delay; ++tick) bench.hold(-9.0, {});
    EXPECT_EQ(bench.motor_n(), -3.3);
  }
}

TEST(HandRig, AnEncoderCounts) {
  ArmModel device = plain(0.05);
  device.encoder_mm = 0.055;
  EXPECT_EQ(HandRig(device, kNone, 0.027, 0.0).encoder_mm(), 0.0);
  EXPECT_EQ(HandRig(device, kNone, 0.028, 0.0).encoder_mm(), 0.055);
  EXPECT_NEAR(HandRig(device, kNone, -1.11, 0.0).encoder_mm(), -1.1, 1e-12);
}

TEST(HapticDevices, EveryRowIsADeviceThatSaysWhereItComesFrom) {
  for (const ArmModel& device : arm_models()) {
    EXPECT_EQ(find_arm_model(device.name), &device);
    EXPECT_NE(std::string(device.provenance), "");
    EXPECT_GT(device.mass_kg, 0.0);
    EXPECT_GT(device.encoder_mm, 0.0);
    EXPECT_GT(device.peak_n, device.continuous_n);
    EXPECT_LE(device.delay_ticks, kMostDelayTicks);
  }
  for (const Hand& hand : hands()) EXPECT_EQ(find_hand(hand.name), &hand);
  EXPECT_EQ(find_hand("third"), nullptr);
  EXPECT_EQ(find_arm_model(""), nullptr);
}

// With more delay the law is softened by the rule, never above its margin.
TEST(HapticDevices, StiffnessKeepsItsMarginToTheBound) {
  for (ArmModel device : arm_models()) {
    double last = INFINITY;
    for (device.delay_ticks = 0; device.delay_ticks <= kMostDelayTicks; ++device.delay_ticks) {
      const NeedleSettings settings = needle_settings(device);
      const double bound =
          (device.damping_n_s_mm + settings.damping_n_s_mm) / (0.5 * settings.tick_s + device.delay_ticks * 0.001);
      EXPECT_LE(settings.stiffness_n_mm, bound / 1.4 * (1.0 + 1e-12));
      EXPECT_LE(settings.stiffness_n_mm, last);
      if (device.delay_ticks > 0) {
        EXPECT_NEAR(settings.stiffness_n_mm, bound / 1.4, 1e-9);
      }
      last = settings.stiffness_n_mm;
    }
  }
}

}  // namespace
}  // namespace seldinger::haptics
