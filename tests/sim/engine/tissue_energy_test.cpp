// Tests of touch by motion_trials: hands on moving tissue gain no more energy than moves the tissue.
#include <gtest/gtest.h>

#include <cmath>

#include "app/measure/rigs/motion_trials.h"
#include "tests/sim/haptics/bodies.h"

namespace seldinger::engine {
namespace {

using measure::breathing_trial;
using measure::coupled_trial;
using measure::EnergyTrial;
using measure::indentation_trial;
using measure::motion_readings;
using measure::TrialPlace;

// Into the kidney of the layered body, beside its middle, where breath moves most; the probe 18 mm beside.
TrialPlace place() {
  TrialPlace made;
  made.entry_lps_mm = {-22.0, 0.0, 0.0};
  made.probe_lps_mm = {-4.0, 0.0, 0.0};
  return made;
}
cases::Case body(double caudal_mm) {
  cases::Case scene = haptics::flat_body();
  scene.yields = true;
  if (caudal_mm > 0.0) {
    scene.breathing.emplace();
    scene.breathing->amplitude_mm = {0.0, 0.0, caudal_mm};
    scene.breathing->irregularity = 0.0;
  }
  return scene;
}

TEST(TissueEnergy, BreathGivesAHandNoMoreThanTissuePutIn) {
  for (const double hand_n_mm : {0.0, 0.05, 0.3, 1.0}) {
    const EnergyTrial trial = breathing_trial(body(16.0), place(), hand_n_mm, 20);
    EXPECT_LE(trial.most_gain_mj, 1.0) << hand_n_mm;
    EXPECT_GT(trial.tissue_mj, 1.0) << "it did work on the needle: " << hand_n_mm;
    EXPECT_LT(trial.drift_mm, 0.1) << hand_n_mm;
    EXPECT_LT(trial.line_mm, 0.01) << hand_n_mm;
    EXPECT_LT(trial.drift_n, 0.05) << hand_n_mm;
  }
}

TEST(TissueEnergy, AProbeThatMovesTissueUnderANeedleMakesNone) {
  for (const double hand_n_mm : {0.0, 0.05, 0.3, 1.0}) {
    const EnergyTrial trial = coupled_trial(body(0.0), place(), hand_n_mm, 20);
    EXPECT_LE(trial.most_gain_mj, 1.0) << hand_n_mm;
    EXPECT_GT(trial.tissue_mj, 0.01) << "the needle felt it: " << hand_n_mm;
    EXPECT_LT(trial.drift_mm, 0.1) << hand_n_mm;
  }
}

TEST(TissueEnergy, AClosedIndentationLoopGivesNone) {
  EXPECT_LT(indentation_trial(body(0.0), place(), 20).most_gain_mj, 0.0) << "friction takes some";
}

TEST(TissueEnergy, TheGoalsHoldHere) {
  const auto readings = motion_readings(haptics::flat_body(), place());
  EXPECT_EQ(readings.size(), 8U);
  for (const measure::ForceReading& one : readings)
    EXPECT_TRUE(one.holds()) << one.what << ", " << one.where << ": " << one.measured;
}

}  // namespace
}  // namespace seldinger::engine
