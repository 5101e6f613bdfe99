// Tests of sim/haptics/needle_law by what a needle's force must do (issue 5; haptics.md §3.4 S3-S6, S12).
#include "sim/haptics/needle_law.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "sim/base/rng.h"
#include "sim/haptics/insertion.h"
#include "tests/fixtures/allocations.h"

namespace seldinger::haptics {
namespace {

const NeedleTissue& tissue(const char* name) {
  return *find_needle_tissue(name);
}

std::vector<InsertionSample> driven(const char* name, double speed_mm_s, double depth_mm, double hold_s = 0.0,
                                    bool retract = false, bool relaxation = false) {
  NeedleSettings settings;
  settings.relaxation = relaxation;
  return insert({tissue(name), speed_mm_s, depth_mm, hold_s, retract}, settings);
}

// Root mean square of force − line over the plateau: behind the rupture and its fall, to the end.
double rmse_to_line(const std::vector<InsertionSample>& samples, const NeedleTissue& of, double speed_mm_s) {
  double rupture_mm = -1.0, sum = 0.0;
  int n = 0;
  for (const InsertionSample& sample : samples) {
    if (sample.force.ruptured) rupture_mm = sample.depth_mm;
    if (rupture_mm < 0.0 || sample.depth_mm < rupture_mm + 2.0 + 0.06 * speed_mm_s) continue;
    const double error = sample.force.axial_n - (of.slope_n_mm * sample.depth_mm + of.intercept_n);
    sum += error * error;
    ++n;
  }
  return n > 100 ? std::sqrt(sum / n) : NAN;
}

TEST(NeedleLaw, KeepsThePublishedLinesAtTheirSpeed) {
  for (const char* name : {"kidney", "liver"}) {
    const double rmse = rmse_to_line(driven(name, 500.0 / 60.0, 80.0), tissue(name), 500.0 / 60.0);
    RecordProperty(std::string("rmse_n_") + name, std::to_string(rmse));
    EXPECT_LE(rmse, 0.065) << name;
  }
}

TEST(NeedleLaw, ACapsuleGivesWayThenOpensOnce) {
  const auto samples = driven("kidney", 500.0 / 60.0, 60.0);
  double peak = 0.0, peak_mm = 0.0;
  int ruptures = 0;
  double last = 0.0;
  for (const InsertionSample& sample : samples) {
    if (sample.force.axial_n > peak) peak = sample.force.axial_n, peak_mm = sample.depth_mm;
    if (sample.force.ruptured) ++ruptures;
    if (ruptures == 0) {
      EXPECT_GE(sample.force.axial_n, last) << sample.depth_mm;
    }
    last = sample.force.axial_n;
  }
  EXPECT_EQ(ruptures, 1);
  EXPECT_NEAR(peak_mm, 10.0, 0.5);
  EXPECT_LT(peak, 3.3);
  EXPECT_GT(peak, 2.0);
}

// S4
TEST(NeedleLaw, ThePlateauIsTheSameAtAnySpeed) {
  for (const NeedleTissue& of : needle_tissues()) {
    if (of.impenetrable) continue;
    for (const bool relaxation : {false, true})
      for (const double speed : {1.0, 8.33, 30.0, 100.0}) {
        const auto samples = driven(of.name, speed, 60.0, 0.0, false, relaxation);
        const double expected = of.slope_n_mm * 60.0 + of.intercept_n;
        EXPECT_NEAR(samples.back().force.axial_n / expected, 1.0, 0.03) << of.name << " at " << speed << " mm/s";
      }
  }
}

// S5
TEST(NeedleLaw, AForceStaysAtRest) {
  for (const char* name : {"kidney", "liver"})
    for (const double speed : {1.0, 8.33, 100.0}) {
      const auto kept = driven(name, speed, 50.0, 2.0), relaxed = driven(name, speed, 50.0, 2.0, false, true);
      const double moving = kept[kept.size() - 2001].force.axial_n;
      ASSERT_EQ(kept[kept.size() - 2001].depth_mm, 50.0);
      EXPECT_NEAR(kept.back().force.axial_n / moving, 1.0, 0.05) << name << speed;
      const double part = relaxed.back().force.axial_n / moving;
      EXPECT_GE(part, 0.60) << name << speed;
      EXPECT_LE(part, 0.97) << name << speed << ": relaxation is felt";
    }
}

TEST(NeedleLaw, RetractionIsFrictionAlone) {
  for (const char* name : {"kidney", "liver"})
    for (const double speed : {1.0, 8.33, 100.0}) {
      const auto samples = driven(name, speed, 80.0, 0.0, true);
      bool back = false;
      int looked = 0;
      for (const InsertionSample& sample : samples) {
        back = back || sample.depth_mm == 80.0;
        if (!back || sample.depth_mm > 60.0 || sample.depth_mm < 1.0) continue;
        const double friction = tissue(name).slope_n_mm * sample.depth_mm;
        EXPECT_NEAR(sample.force.axial_n, -friction, 0.005) << name << " at " << sample.depth_mm;
        ++looked;
      }
      EXPECT_GT(looked, 100);
      EXPECT_NEAR(samples.back().force.axial_n, 0.0, 1e-3) << "out is out";
    }
}

TEST(NeedleLaw, TheSameTrackIsNotCutTwice) {
  const NeedleLayer layer{0.0, tissue("kidney")};
  NeedleLaw law({&layer, 1}, {});
  double depth = 0.0;
  const auto to = [&](double target, auto&& look) {
    while (std::abs(depth - target) > 1e-9) {
      depth += std::clamp(target - depth, -0.01, 0.01);
      look(law.advance(depth));
    }
  };
  const auto nothing = [](const NeedleForce&) {};
  to(50.0, nothing);
  to(5.0, nothing);
  // The wall stands where the tip stopped less its reach; until then the tip feels nothing.
  const double cut_mm = 50.0 - 1.53 / (1.0 - 0.010 / 0.25) / 0.25;
  to(cut_mm - 0.1, [&](const NeedleForce& force) {
    EXPECT_EQ(force.tip_n, 0.0) << depth;
    EXPECT_FALSE(force.ruptured);
    EXPECT_LE(force.axial_n, 0.010 * depth + 0.01);
  });
  to(60.0, [&](const NeedleForce& force) { EXPECT_FALSE(force.ruptured); });
  EXPECT_NEAR(law.advance(depth).axial_n, 0.010 * 60.0 + 1.53, 0.01) << "beyond it, it cuts again";
  EXPECT_EQ(law.ruptures(), 1U);
}

// S3, with ideal motion: the encoder alone.
TEST(NeedleLaw, SlowInsertionThroughACoarseEncoderIsSmooth) {
  constexpr double kEncoderMm = 0.055;
  for (const char* name : {"kidney", "liver"})
    for (const bool relaxation : {false, true}) {
      const NeedleLayer layer{0.0, tissue(name)};
      NeedleSettings settings;
      settings.relaxation = relaxation;
      NeedleLaw law({&layer, 1}, settings);
      double sum = 0.0;
      int n = 0;
      for (int i = 0; i < 80000; ++i) {
        const double depth = 0.0005 * i;
        const double error = law.advance(std::floor(depth / kEncoderMm) * kEncoderMm).axial_n -
                             (tissue(name).slope_n_mm * depth + tissue(name).intercept_n);
        if (depth < 20.0) continue;
        sum += error * error;
        ++n;
      }
      EXPECT_LE(std::sqrt(sum / n), 0.03) << name << (relaxation ? " relaxing" : "");
    }
}

// S6
TEST(NeedleLaw, AForceComesWithoutDelay) {
  const NeedleLayer layer{0.0, tissue("bone")};
  NeedleSettings settings;
  NeedleLaw law({&layer, 1}, settings);
  law.advance(-1.0);
  const double final_n = settings.stiffness_n_mm * 1.0;
  double force = 0.0;
  for (int i = 0; i < 3; ++i) force = law.advance(1.0).axial_n;
  EXPECT_GE(force, 0.63 * final_n);
  for (int i = 0; i < 100; ++i) force = law.advance(1.0).axial_n;
  EXPECT_NEAR(force, final_n, 1e-6);
}

TEST(NeedleLaw, NoTickIsAStepUpTo200MmPerSecond) {
  for (const NeedleTissue& of : needle_tissues()) {
    if (of.impenetrable) continue;
    for (const double speed : {1.0, 8.33, 50.0, 100.0, 200.0}) {
      const auto samples = insert({of, speed, 70.0, 0.1, true}, {});
      for (std::size_t i = 1; i < samples.size(); ++i) {
        if (samples[i].force.ruptured) continue;
        const double step = samples[i].force.axial_n - samples[i - 1].force.axial_n;
        // In the ticks after a rupture its fall is the declared event.
        const bool falls = samples[i - 1].force.rupture_n > 0.05;
        EXPECT_LE(std::abs(step), falls ? 0.30 : 0.15) << of.name << " " << speed << " at " << samples[i].depth_mm;
        if (samples[i].force.axial_n != samples[i].force.axial_n) FAIL();
      }
    }
  }
}

// S12: body wall, organ and bone under a hand that changes its mind.
TEST(NeedleLaw, AnyWanderingThroughLayersIsContinuousAndBounded) {
  const NeedleLayer layers[] = {{0.0, tissue("skin")},    {2.0, tissue("fat")},    {15.0, tissue("muscle")},
                                {35.0, tissue("kidney")}, {80.0, tissue("bone")}};
  NeedleSettings settings;
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    NeedleLaw law(layers, settings);
    base::Rng rng(seed);
    double depth = -5.0, speed = 0.0, last = 0.0;
    for (int i = 0; i < 100000; ++i) {
      speed = std::clamp(speed + 4.0 * rng.normal() + 0.002 * (45.0 - depth), -200.0, 200.0);
      depth += 0.001 * speed;
      if (depth < -10.0 || depth > 88.0) speed = -speed;
      depth = std::clamp(depth, -10.0, 88.0);
      const NeedleForce force = law.advance(depth);
      ASSERT_TRUE(std::isfinite(force.axial_n));
      EXPECT_GE(force.tip_n, 0.0);
      EXPECT_LE(std::abs(force.shaft_n), 0.010 * 88.0 + 1e-9);
      const double most = force.rupture_n > 0.05 || force.rupture_n < -0.05 ? 0.40 : 0.15;
      if (!force.ruptured) {
        EXPECT_LE(std::abs(force.axial_n - last), most) << depth << " at " << speed << " seed " << seed;
      }
      if (depth <= 0.0) EXPECT_NEAR(force.tip_n + force.shaft_n, 0.0, 1e-12);
      last = force.axial_n;
    }
    EXPECT_EQ(law.ruptures(), 4U) << "bone never opens; seed " << seed;
  }
}

TEST(NeedleLaw, BoneIsAWallAsStiffAsTheDeviceMayShow) {
  const NeedleLayer layers[] = {{0.0, tissue("muscle")}, {30.0, tissue("bone")}};
  NeedleSettings settings;
  NeedleLaw law(layers, settings);
  double at[2];
  for (int i = 0; i <= 6000; ++i) {
    const NeedleForce force = law.advance(0.01 * i);
    if (i == 5500) at[0] = force.axial_n;
    if (i == 6000) at[1] = force.axial_n;
  }
  const double slope = (at[1] - at[0]) / 5.0;
  EXPECT_LE(slope, settings.stiffness_n_mm * 1.0001);
  EXPECT_GE(slope, 0.6 * settings.stiffness_n_mm);
}

// The sum of all tangents is what stability asks of a law: over a tiny step in either direction, damper off.
TEST(NeedleLaw, StaysBelowItsStiffnessEverywhere) {
  const NeedleLayer layers[] = {{0.0, tissue("skin")}, {8.0, tissue("muscle")}, {40.0, tissue("kidney")}};
  for (const double stiffness : {0.2, 0.476, 1.4}) {
    NeedleSettings settings;
    settings.stiffness_n_mm = stiffness;
    settings.damping_n_s_mm = 0.0;
    NeedleLaw law(layers, settings);
    constexpr double kStepMm = 0.02;
    double last = 0.0, steepest = 0.0;
    for (int i = 0; i < 20000; ++i) {
      // Three steps in, one back, so that both branches are walked everywhere.
      static double depth;
      if (i == 0) depth = 0.0;
      depth += i % 4 == 3 ? -kStepMm : kStepMm;
      const NeedleForce force = law.advance(depth);
      const double elastic = force.tip_n + force.shaft_n;
      if (!force.ruptured) steepest = std::max(steepest, std::abs(elastic - last) / kStepMm);
      last = elastic;
    }
    EXPECT_EQ(law.ruptures(), 3U);
    EXPECT_LE(steepest, stiffness * 1.02) << stiffness;
  }
}

TEST(NeedleLaw, AdvanceAllocatesNothingAndRepeatsItself) {
  const NeedleLayer layers[] = {{0.0, tissue("skin")}, {2.0, tissue("liver")}};
  NeedleLaw law(layers, {});
  std::vector<double> first;
  first.reserve(5000);
  const long before = fixtures::allocations();
  for (int i = 0; i < 5000; ++i) first.push_back(law.advance(0.01 * i).axial_n);
  EXPECT_EQ(fixtures::allocations(), before);
  law.reset();
  for (int i = 0; i < 5000; ++i) EXPECT_EQ(law.advance(0.01 * i).axial_n, first[i]);
}

// What a hand puts in and gets back over closed ways: never more back.
TEST(NeedleLaw, GivesNoEnergy) {
  for (const char* name : {"kidney", "liver", "bone"}) {
    const NeedleLayer layer{0.0, tissue(name)};
    NeedleLaw law({&layer, 1}, {});
    base::Rng rng(7);
    double depth = 0.0, speed = 0.0, work_mj = 0.0, least = 0.0, force = 0.0;
    for (int i = 0; i < 60000; ++i) {
      speed = std::clamp(speed + 2.0 * rng.normal(), -100.0, 100.0);
      const double next = std::clamp(depth + 0.001 * speed, -2.0, 40.0);
      // The force held over the tick, as a sampled device feels it.
      work_mj += force * (next - depth);
      depth = next;
      force = law.advance(depth).axial_n;
      least = std::min(least, work_mj);
    }
    EXPECT_GE(least, -1.0) << name;
  }
}

}  // namespace
}  // namespace seldinger::haptics
