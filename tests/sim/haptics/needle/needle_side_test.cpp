// Tests of sim/haptics/needle/needle_side: the beam against its equation, no switch with depth, no energy, rest
// (S13).
#include "sim/haptics/needle/needle_side.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "sim/base/rng.h"
#include "sim/haptics/hand_rig.h"

namespace seldinger::haptics {
namespace {

const cases::Gauge kNeedle = *cases::gauge(22);

TEST(NeedleSide, BendingIsThatOfATube) {
  EXPECT_NEAR(bending_stiffness_n_mm2(kNeedle), 2.2e3, 0.15e3);           // E · π/4 · (R⁴ − r⁴)
  EXPECT_NEAR(bending_stiffness_n_mm2(*cases::gauge(18)), 2.1e4, 0.1e4);  // so too
}

// E I y'''' = − k y by finite differences with free ends and 1 N at the first: a second way to the same number.
double by_differences_n_mm(double length_mm, double bending, double foundation) {
  constexpr int kNodes = 401;
  const double h = length_mm / (kNodes - 1);
  // Minimum of the energy ½ ∫ E I y''² + ½ ∫ k y² − y(0), with y'' at inner nodes: a symmetric banded system.
  std::vector<std::vector<double>> a(kNodes, std::vector<double>(5, 0.0));  // a[i][j]: column i + j − 2
  const double bend = bending / (h * h * h);
  const double w[3] = {1.0, -2.0, 1.0};
  for (int i = 1; i + 1 < kNodes; ++i)
    for (int p = 0; p < 3; ++p)
      for (int q = 0; q < 3; ++q) a[i - 1 + p][2 + q - p] += bend * w[p] * w[q];
  for (int i = 0; i < kNodes; ++i) a[i][2] += foundation * h * (i == 0 || i == kNodes - 1 ? 0.5 : 1.0);
  std::vector<double> y(kNodes, 0.0);
  y[0] = 1.0;
  for (int i = 0; i < kNodes; ++i)
    for (int j = 1; j <= 2 && i + j < kNodes; ++j) {
      const double factor = a[i + j][2 - j] / a[i][2];
      for (int column = i; column <= std::min(kNodes - 1, i + 2); ++column)
        a[i + j][2 + column - i - j] -= factor * a[i][2 + column - i];
      y[i + j] -= factor * y[i];
    }
  for (int i = kNodes - 1; i >= 0; --i) {
    for (int j = 1; j <= 2 && i + j < kNodes; ++j) y[i] -= a[i][2 + j] * y[i + j];
    y[i] /= a[i][2];
  }
  return 1.0 / y[0];
}

TEST(NeedleSide, StiffnessIsTheBeams) {
  const double bending = bending_stiffness_n_mm2(kNeedle);
  for (const double length_mm : {5.0, 20.0, 50.0, 80.0, 150.0})
    EXPECT_NEAR(side_stiffness_n_mm(length_mm, bending, 0.01) / by_differences_n_mm(length_mm, bending, 0.01), 1.0,
                0.01)
        << length_mm;
  EXPECT_NEAR(side_stiffness_n_mm(0.5, bending, 0.01), 0.25 * 0.01 * 0.5, 1e-9) << "short: a rigid bar";
  const double lambda = std::pow(0.01 / (4.0 * bending), 0.25);
  EXPECT_NEAR(side_stiffness_n_mm(1000.0, bending, 0.01), 0.01 / (2.0 * lambda), 1e-9) << "long: half infinite";
  EXPECT_EQ(side_stiffness_n_mm(0.0, bending, 0.01), 0.0);
}

// The thesis held the needle from 2 cm on; nothing happens at any depth here.
TEST(NeedleSide, GrowsSteadilyFromNothing) {
  for (const int gauge : {16, 22, 25}) {
    const double bending = bending_stiffness_n_mm2(*cases::gauge(gauge));
    double last = 0.0;
    for (double length = 0.01; length < 200.0; length += 0.01) {
      const double stiffness = side_stiffness_n_mm(length, bending, kFoundationNMm2);
      // A beam of this length is nowhere softer than a shorter one, but for a hundredth where it gets long.
      ASSERT_GE(stiffness, 0.99 * last);
      ASSERT_LE(stiffness - last, 0.25 * kFoundationNMm2 * 0.01 * 1.5);
      last = stiffness;
    }
    EXPECT_LT(last, 0.48) << "within what a device may show";
  }
}

TEST(NeedleSide, HoldsTheNeedleWhereItWentIn) {
  const NeedleSideLaw law({}, kNeedle);
  NeedleSideTrack track;
  glm::dvec3 force(0.0);
  for (int i = 0; i <= 5000; ++i) force = law.advance({0, 0, 0}, 0.01 * i, track);
  EXPECT_EQ(force, glm::dvec3(0.0)) << "straight in";
  for (int i = 0; i <= 1000; ++i) force = law.advance({0.002 * i, -0.001 * i, 0}, 50.0, track);
  for (int i = 0; i <= 200; ++i) force = law.advance({2.0, -1.0, 0}, 50.0, track);
  const double stiffness = side_stiffness_n_mm(50.0, bending_stiffness_n_mm2(kNeedle), kFoundationNMm2);
  EXPECT_NEAR(force.x, -2.0 * stiffness, 1e-9);
  EXPECT_NEAR(force.y, 1.0 * stiffness, 1e-9);
  // Pulled out while shifted, all of it goes; in again at the new place, nothing pulls back.
  for (int i = 5000; i >= 0; --i) force = law.advance({2.0, -1.0, 0}, 0.01 * i, track);
  EXPECT_NEAR(force.x, 0.0, 1e-3);
  for (int i = 0; i <= 5000; ++i) force = law.advance({2.0, -1.0, 0}, 0.01 * i, track);
  EXPECT_NEAR(force.x, 0.0, 1e-3);
}

TEST(NeedleSide, GivesNoEnergyAndNoSteps) {
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    const NeedleSideLaw law({}, kNeedle);
    NeedleSideTrack track;
    base::Rng rng(seed);
    glm::dvec3 shift(0.0), speed(0.0), force(0.0);
    double inserted = 40.0, deeper = 0.0, work_mj = 0.0, least_mj = 0.0;
    for (int i = 0; i < 60000; ++i) {
      for (int axis = 0; axis < 2; ++axis)
        speed[axis] = std::clamp(speed[axis] + 2.0 * rng.normal() - 0.02 * shift[axis], -100.0, 100.0);
      deeper = std::clamp(deeper + 2.0 * rng.normal(), -100.0, 100.0);
      inserted = std::clamp(inserted + 0.001 * deeper, 0.0, 120.0);
      work_mj -= glm::dot(force, 0.001 * speed);
      shift += 0.001 * speed;
      const glm::dvec3 next = law.advance(shift, inserted, track);
      EXPECT_LE(glm::length(next - force), 0.15);
      force = next;
      least_mj = std::min(least_mj, work_mj);
    }
    EXPECT_GE(least_mj, -1.0) << seed;
  }
}

struct Swing {
  double settled_s = 0.0;
  int overshoots = 0;
};

// S13: 1 N sideways, held, then let go of. Settled: within a tenth of the way it was pushed.
Swing released(const ArmModel& device, const Hand& hand, double inserted_mm) {
  const NeedleSideLaw law(needle_settings(device), kNeedle);
  NeedleSideTrack track;
  HandRig bench(device, hand, 0.0, 0.0);
  law.advance({0, 0, 0}, inserted_mm, track);
  const auto tick = [&](double push_n) {
    bench.hold(-law.advance({bench.encoder_mm(), 0, 0}, inserted_mm, track).x, {0.0, 0.0, push_n});
  };
  for (int i = 0; i < 2000; ++i) tick(1.0);
  const double pushed_mm = bench.at_mm();
  EXPECT_GT(pushed_mm, 0.2);
  // Where it ends: dry friction may hold it before the middle.
  std::vector<double> way;
  for (int i = 0; i < 3000; ++i) {
    tick(0.0);
    way.push_back(bench.at_mm());
  }
  Swing swing;
  bool beyond = false;
  for (std::size_t i = 0; i < way.size(); ++i) {
    const double off = (way[i] - way.back()) / pushed_mm;
    if (std::abs(off) > 0.1) swing.settled_s = 0.001 * static_cast<double>(i + 1);
    if (off < -0.1 && !beyond) ++swing.overshoots;
    if (off < -0.1) beyond = true;
    if (off > 0.1) beyond = false;
  }
  EXPECT_LE(std::abs(way.back() - way[way.size() - 500]), device.encoder_mm) << "it rests";
  return swing;
}

TEST(NeedleSide, AReleasedNeedleSettles) {
  for (const double inserted_mm : {5.0, 20.0, 50.0, 120.0})
    for (ArmModel device : arm_models())
      for (device.delay_ticks = 0; device.delay_ticks <= kMostDelayTicks; ++device.delay_ticks)
        for (const char* name : {"light", "medium", "firm"}) {
          const Swing swing = released(device, *find_hand(name), inserted_mm);
          // A light hand swings by itself: 0.05 kg on 0.1 N/mm with 1 N s/m.
          const bool light = std::string(name) == "light";
          EXPECT_LE(swing.settled_s, light ? 0.4 : 0.150) << device.name << " " << name << " " << inserted_mm;
          EXPECT_LE(swing.overshoots, light ? 2 : 1) << device.name << " " << name << " " << inserted_mm;
        }
}

}  // namespace
}  // namespace seldinger::haptics
