// Breathing: the wave, its irregularity, holds that come late and fail, coughs; and where in a trunk it moves what.
#include "sim/tissue/breathing.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "sim/tissue/displacement.h"
#include "sim/volume/phantom.h"
#include "sim/volume/tissue/find_tissue.h"

namespace seldinger::tissue {
namespace {

constexpr double kTickS = 0.001;

std::vector<double> breathe(const BreathSettings& settings, int ticks, BreathState& state, BreathAsks asks = {}) {
  std::vector<double> levels;
  for (int i = 0; i < ticks; ++i) {
    levels.push_back(advance(settings, kTickS, asks, state));
    asks.cough = false;
  }
  return levels;
}

double most_step(const std::vector<double>& levels) {
  double most = 0.0;
  for (std::size_t i = 1; i < levels.size(); ++i) most = std::max(most, std::abs(levels[i] - levels[i - 1]));
  return most;
}

// Lujan: cos^2n; with n = 2 a breath is below a half for 63.7 % of its time: ⅔ and more at rest.
TEST(Breathing, IsLujansWave) {
  const BreathSettings settings{.irregularity = 0.0};
  BreathState state;
  const std::vector<double> levels = breathe(settings, 8000, state);
  for (int i = 0; i < 8000; ++i) {
    const double wave = std::cos(std::numbers::pi * ((i + 1) * kTickS / 4.0) - 0.5 * std::numbers::pi);
    ASSERT_NEAR(levels[static_cast<std::size_t>(i)], std::pow(wave, 4.0), 1e-9) << i;
  }
  EXPECT_NEAR(static_cast<double>(std::count_if(levels.begin(), levels.end(), [](double x) { return x < 0.5; })),
              8000.0 * (1.0 - 2.0 / std::numbers::pi * std::acos(std::pow(0.5, 0.25))), 10.0);
}

TEST(Breathing, IsIrregularAsToldAndTheSameFromTheSameSeed) {
  BreathSettings settings{.irregularity = 0.1, .seed = 7};
  BreathState state, again;
  const std::vector<double> levels = breathe(settings, 2000000, state);
  EXPECT_EQ(levels, breathe(settings, 2000000, again));
  EXPECT_LT(most_step(levels), 0.0025) << "without a jump from breath to breath";
  std::vector<double> peaks;
  for (std::size_t i = 1; i + 1 < levels.size(); ++i)
    if (levels[i] > 0.3 && levels[i] >= levels[i - 1] && levels[i] > levels[i + 1]) peaks.push_back(levels[i]);
  EXPECT_NEAR(static_cast<double>(peaks.size()), 500.0, 15.0);
  double mean = 0.0, squares = 0.0;
  for (const double peak : peaks) mean += peak / static_cast<double>(peaks.size());
  for (const double peak : peaks) squares += (peak - mean) * (peak - mean) / static_cast<double>(peaks.size());
  EXPECT_NEAR(mean, 1.0, 0.015);
  EXPECT_NEAR(std::sqrt(squares), 0.09, 0.02) << "0.1, cut off at two standard deviations";
  settings.seed = 8;
  BreathState other;
  EXPECT_NE(levels, breathe(settings, 2000000, other));
}

TEST(Breathing, IsHeldAfterADelayAndFailsAfterATime) {
  const BreathSettings settings{.irregularity = 0.0, .hold_level = 0.2};
  BreathState state;
  breathe(settings, 1300, state);
  const std::vector<double> levels = breathe(settings, 25000, state, {.hold = true});
  EXPECT_LT(most_step(levels), 0.004);
  // Until the delay is over it breathes as before; half a second later it is still.
  EXPECT_GT(std::abs(levels[1400] - levels[900]), 0.01);
  for (int i = 2010; i < 16490; ++i) ASSERT_NEAR(levels[static_cast<std::size_t>(i)], 0.2, 1e-12) << i;
  // Then it breathes again, although it is still asked not to.
  EXPECT_GT(*std::max_element(levels.begin() + 17000, levels.end()), 0.99);
  EXPECT_FALSE(holds(state));
  // Let go and asked anew, it holds anew.
  breathe(settings, 10, state);
  breathe(settings, 2100, state, {.hold = true});
  EXPECT_TRUE(holds(state));
  // Let go it breathes.
  EXPECT_GT(*std::max_element(levels.begin() + 17000, levels.end()), 0.99);
  const std::vector<double> after = breathe(settings, 5000, state);
  EXPECT_GT(*std::max_element(after.begin(), after.end()), 0.99);
  EXPECT_FALSE(holds(state));
}

TEST(Breathing, ACoughThrowsTheDiaphragmUpAndEndsAHold) {
  const BreathSettings settings{.irregularity = 0.0};
  BreathState state;
  breathe(settings, 3000, state, {.hold = true});
  ASSERT_TRUE(holds(state));
  const std::vector<double> levels = breathe(settings, 1000, state, {.hold = true, .cough = true});
  EXPECT_NEAR(*std::min_element(levels.begin(), levels.end()), -0.55, 0.05);
  EXPECT_LT(most_step(levels), 0.03) << "0.5 mm a tick";
  EXPECT_FALSE(holds(state));
  EXPECT_EQ(state.cough_s, 0.0) << "it is over";
  const std::vector<double> after = breathe(settings, 5000, state, {.hold = true});
  EXPECT_GT(*std::max_element(after.begin(), after.end()), 0.99) << "the hold is over, until it is asked for anew";
}

// Of an adult who breathes `depth` quiet breaths deep, by the numbers of cases.
BreathSettings breathing_of(double depth) {
  BreathSettings settings{.amplitude_mm = depth * cases::breath::kQuietMm};
  settings.hold_spread = cases::breath::kHoldSpreadMm / settings.amplitude_mm.z;
  settings.hold_drift_per_s = cases::breath::kHoldDriftMmPerS / settings.amplitude_mm.z;
  return settings;
}

TEST(Breathing, HoldsDifferByAFewMmAndDriftUpwards) {
  for (const double depth : {1.0, cases::breath::kDeepest}) {
    const BreathSettings settings = breathing_of(depth);
    const double mm = settings.amplitude_mm.z;
    BreathState state, again;
    std::vector<double> held_mm;
    for (int hold = 0; hold < 150; ++hold) {
      const std::vector<double> levels = breathe(settings, 7000, state, {.hold = true});
      ASSERT_EQ(levels, breathe(settings, 7000, again, {.hold = true})) << "the same from the same seed";
      ASSERT_LT(most_step(levels), 0.005) << "no jump into a hold";
      ASSERT_TRUE(holds(state));
      ASSERT_NEAR((levels[2500] - levels[6500]) * mm, 4.0 * cases::breath::kHoldDriftMmPerS, 1e-9);
      held_mm.push_back(levels[2000] * mm);
      const std::vector<double> after = breathe(settings, 3000, state);
      ASSERT_EQ(after, breathe(settings, 3000, again));
      ASSERT_LT(std::abs(after[0] - levels.back()), 0.005) << "no jump out of it";
      ASSERT_LT(most_step(after), 0.005);
    }
    double mean = 0.0, squares = 0.0;
    for (const double one : held_mm) mean += one / 150.0;
    for (const double one : held_mm) squares += (one - mean) * (one - mean) / 150.0;
    EXPECT_NEAR(mean, -0.5 * cases::breath::kHoldDriftMmPerS, 0.6);
    EXPECT_NEAR(std::sqrt(squares), 0.88 * cases::breath::kHoldSpreadMm, 0.4) << "cut off at two deviations";
    EXPECT_NE(held_mm[0], held_mm[1]);
  }
}

TEST(Breathing, OfCasesOfBeforeIsHeldAlikeAndStill) {
  const BreathSettings settings;
  BreathState state;
  for (int hold = 0; hold < 3; ++hold) {
    const std::vector<double> levels = breathe(settings, 7000, state, {.hold = true});
    for (int i = 2100; i < 7000; ++i) ASSERT_EQ(levels[static_cast<std::size_t>(i)], 0.0) << i;
    breathe(settings, 3000, state);
    EXPECT_EQ(state.hold_off, 0.0);
  }
}

// Quiet: downwards 10 to 20, to the front 2 to 8. Deep: downwards 37 ± 8 (Davies 1994), to the front 9 to 21 (de
// Jong 2019). Whether the CT saw them breathed out or in, the way is the same, and nothing folds.
TEST(BreathRegion, ExcursionsOfQuietAndDeepBreathsAreAsPublished) {
  const BreathRegion region;
  for (const bool deep : {false, true})
    for (const double ct_level : {0.0, 1.0}) {
      BreathSettings settings = breathing_of(deep ? cases::breath::kDeepest : 1.0);
      settings.ct_level = ct_level;
      const auto at = [&](double level) {
        return displacement_of({.breath = Breath{region, breath_amount_mm(settings, level)}});
      };
      const Displacement out = at(0.0), in = at(1.0);
      for (const glm::dvec3& place : {glm::dvec3(-60, -10, -60), {62, 45, -115}, {0, -110, 0}})
        EXPECT_EQ(displaced(at(ct_level), place), place) << "there the CT saw it";
      const double down_mm = displaced(out, {0, -60, 0}).z - displaced(in, {0, -60, 0}).z;
      const double front_mm = displaced(out, {0, -110, 0}).y - displaced(in, {0, -110, 0}).y;
      EXPECT_GE(down_mm, deep ? 29.0 : 10.0);
      EXPECT_LE(down_mm, deep ? 45.0 : 20.0);
      EXPECT_GE(front_mm, deep ? 9.0 : 2.0);
      EXPECT_LE(front_mm, deep ? 21.0 : 8.0);
      const Displacement far = at(1.0 - ct_level);
      double least = 1.0;
      for (double x = -170.0; x <= 170.0; x += 10.0)
        for (double y = -110.0; y <= 110.0; y += 10.0)
          for (double z = -360.0; z <= 220.0; z += 10.0) least = std::min(least, volume_ratio(far, {x, y, z}));
      EXPECT_GT(least, 0.5) << deep << ct_level;
    }
}

TEST(BreathRegion, MovesOrgansAsPublishedAndLeavesSpineAndWall) {
  const BreathSettings settings;
  const BreathRegion region;  // dome at z 0, back at y 110, front at −110
  const Displacement in = displacement_of({.breath = Breath{region, breath_amount_mm(settings, 1.0)}});
  ASSERT_EQ(count_sources(in), 1);
  const auto u_mm = [&](double x, double y, double z) { return displaced(in, {x, y, z}) - glm::dvec3(x, y, z); };
  // de Jong 2019: right 2, anterior 15, caudal 16 (6 to 24) where it is most. LPS: right −x, front −y, down −z.
  EXPECT_NEAR(u_mm(0.0, -60.0, 0.0).z, -16.0, 1e-5);
  EXPECT_NEAR(u_mm(0.0, -110.0, 0.0).y, -15.0, 1e-5);
  const glm::dvec3 liver = u_mm(-60.0, -10.0, -60.0);
  EXPECT_LT(liver.z, -12.0);
  EXPECT_LT(liver.x, -1.0);
  EXPECT_LT(liver.y, -4.0);
  // Song 2011: a kidney goes 0.6 to 0.7 as far as the diaphragm.
  for (const double side : {-1.0, 1.0}) {
    const double kidney = u_mm(side * 62.0, 45.0, -115.0).z;
    EXPECT_LT(kidney, -0.6 * 16.0);
    EXPECT_GT(kidney, -0.7 * 16.0);
  }
  // The spine, the back and the pelvis stay; the wall goes nowhere but out.
  EXPECT_LT(glm::length(u_mm(0.0, 65.0, -60.0)), 2.0);
  EXPECT_LT(std::abs(u_mm(0.0, 65.0, -60.0).z), 0.1);
  EXPECT_LT(glm::length(u_mm(20.0, 108.0, -60.0)), 0.1);
  EXPECT_LT(glm::length(u_mm(30.0, -40.0, -360.0)), 1e-9);
  EXPECT_LT(std::abs(u_mm(170.0, 0.0, -60.0).z), 1e-3);
  EXPECT_LT(std::abs(u_mm(0.0, -110.0, -60.0).z), 1e-3);
  // Nothing folds.
  double least = 1.0;
  for (double x = -170.0; x <= 170.0; x += 5.0)
    for (double y = -110.0; y <= 110.0; y += 5.0)
      for (double z = -360.0; z <= 220.0; z += 10.0) least = std::min(least, volume_ratio(in, {x, y, z}));
  EXPECT_GT(least, 0.5);
}

// S18 of docs/touch.md: 16 mm every 4 s.
TEST(BreathRegion, MovesNoFasterThanADiaphragm) {
  const BreathSettings settings{.irregularity = 0.0};
  BreathState state;
  const std::vector<double> levels = breathe(settings, 4000, state);
  EXPECT_LT(most_step(levels) * 16.0 / kTickS, 30.0) << "mm/s";
}

TEST(BreathRegion, FindsTheDomeOfTheTorso) {
  cases::Case scene;
  EXPECT_FALSE(breath_region(scene).has_value());
  scene.volume = volume::make_phantom().volume;
  scene.classes = volume::tissue_classes(scene.volume);
  const glm::dvec3 first(scene.volume.lps_from_voxel[3]);
  const glm::dvec3 last(scene.volume.lps_from_voxel * glm::dvec4(glm::dvec3(scene.volume.size_voxels - 1), 1.0));
  scene.skin.vertices_lps_mm = {glm::vec3(first), glm::vec3(last)};
  const auto region = breath_region(scene);
  ASSERT_TRUE(region.has_value());
  EXPECT_GT(region->dome_z_mm, std::min(first.z, last.z));
  EXPECT_LT(region->dome_z_mm, std::max(first.z, last.z));
  EXPECT_GT(region->half_width_mm, 50.0);
  EXPECT_GT(region->depth_mm, 50.0);
  // Without classes its top counts.
  scene.classes.clear();
  EXPECT_NEAR(breath_region(scene)->dome_z_mm, std::max(first.z, last.z), 1e-3);
}

}  // namespace
}  // namespace seldinger::tissue
