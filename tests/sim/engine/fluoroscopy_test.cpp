// Tests of sim/engine/fluoroscopy, through step().
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "sim/base/rng.h"
#include "sim/engine/step.h"
#include "tests/fixtures/allocations.h"
#include "tests/fixtures/meshes.h"

namespace seldinger::engine {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

cases::Case xray_case() {
  cases::Case scene;
  scene.picture.modality = cases::Modality::xray;
  return scene;
}

struct Room {
  cases::Case scene = xray_case();
  cases::State state;
  cases::Inputs inputs;
  int pulses = 0;
  const cases::FluoroscopyState& machine() const { return state.fluoroscopy; }
  void run(double seconds) {
    const int ticks = static_cast<int>(std::lround(seconds / base::kTickS));
    for (int i = 0; i < ticks; ++i) {
      step(scene, inputs, base::kTickS, state);
      pulses += machine().frame_due ? 1 : 0;
    }
  }
};

TEST(Fluoroscope, StartsWhereTheCaseSays) {
  Room room;
  room.scene.fluoroscope.start = {12.0, -7.0, 1000.0, {1, 2, 3}};
  room.run(0.001);
  EXPECT_EQ(room.machine().arm, room.scene.fluoroscope.start);
  EXPECT_FALSE(room.machine().arm_moving);
}

TEST(Fluoroscope, TurnsAtItsSpeedAndStopsAtItsLimits) {
  Room room;
  room.inputs.fluoroscope.lao_speed = 1.0;
  room.inputs.fluoroscope.cranial_speed = -0.5;
  room.run(2.0);
  EXPECT_NEAR(room.machine().arm.lao_deg, 50.0, 1e-9);
  EXPECT_NEAR(room.machine().arm.cranial_deg, -25.0, 1e-9);
  EXPECT_TRUE(room.machine().arm_moving);
  room.run(10.0);
  EXPECT_EQ(room.machine().arm.lao_deg, 100.0);
  EXPECT_EQ(room.machine().arm.cranial_deg, -45.0);
  EXPECT_FALSE(room.machine().arm_moving) << "against its stop it stands";
}

TEST(Fluoroscope, DetectorAndTableMoveWithinTheirTravel) {
  Room room;
  room.scene.fluoroscope.start.isocentre_lps_mm = {10, 20, 30};
  room.inputs.fluoroscope.sid_speed = -1.0;
  room.inputs.fluoroscope.table_speed = {1.0, -1.0, 0.25};
  room.run(1.0);
  EXPECT_NEAR(room.machine().arm.sid_mm, 1000.0, 1e-9);
  EXPECT_NEAR(glm::length(room.machine().arm.isocentre_lps_mm - glm::dvec3(110, -80, 55)), 0.0, 1e-9);
  room.run(30.0);
  EXPECT_EQ(room.machine().arm.sid_mm, 900.0);
  EXPECT_NEAR(glm::length(room.machine().arm.isocentre_lps_mm - glm::dvec3(410, -380, 430)), 0.0, 1e-9);
  room.inputs.fluoroscope.sid_speed = 1.0;
  room.run(30.0);
  EXPECT_EQ(room.machine().arm.sid_mm, 1200.0);
}

TEST(Fluoroscope, PulsesAtItsRateWhileThePedalIsDown) {
  for (int rate = 0; rate < 3; ++rate) {
    Room room;
    room.inputs.fluoroscope.pulse_rate = rate;
    room.run(1.0);
    EXPECT_EQ(room.pulses, 0) << "nobody has pressed";
    room.inputs.fluoroscope.pedal = true;
    room.run(10.0);
    const double hz = cases::kPulseRateHz[static_cast<std::size_t>(rate)];
    EXPECT_EQ(room.pulses, static_cast<int>(std::lround(10.0 * hz))) << hz;
    EXPECT_EQ(room.machine().frames, static_cast<std::uint32_t>(room.pulses));
    EXPECT_NEAR(room.machine().fluoroscopy_time_s, 10.0, 0.01);
    EXPECT_TRUE(room.machine().live);
    room.inputs.fluoroscope.pedal = false;
    room.run(1.0);
    EXPECT_EQ(room.pulses, static_cast<int>(std::lround(10.0 * hz)));
    EXPECT_FALSE(room.machine().live) << "the last image is held";
  }
}

TEST(Fluoroscope, TheFirstPulseComesAtOnceAndTappingDoesNotBeatTheRate) {
  Room room;
  room.inputs.fluoroscope.pulse_rate = 1;
  room.inputs.fluoroscope.pedal = true;
  room.run(0.001);
  EXPECT_EQ(room.pulses, 1);
  for (int i = 0; i < 1000; ++i) {
    room.inputs.fluoroscope.pedal = i % 2 == 0;
    room.run(0.001);
  }
  EXPECT_GE(room.pulses, 7);
  EXPECT_LE(room.pulses, 8);
}

TEST(Fluoroscope, ThePictureIsLiveForTheTimeAPulseStandsFor) {
  Room room;
  room.inputs.fluoroscope.pulse_rate = 0;
  room.inputs.fluoroscope.pedal = true;
  room.run(0.001);
  room.inputs.fluoroscope.pedal = false;
  room.run(0.330);
  EXPECT_TRUE(room.machine().live);
  room.run(0.010);
  EXPECT_FALSE(room.machine().live);
  EXPECT_NEAR(room.machine().fluoroscopy_time_s, 1.0 / 3.0, 1e-12);
}

TEST(Fluoroscope, AReportCountsExactlyOnce) {
  Room room;
  room.inputs.fluoroscope.pedal = true;
  room.run(0.001);
  room.inputs.fluoroscope.pedal = false;
  cases::ExposureReport report{1, 0.25, 30.0, {81.0, 44.0, 6.0}, true};
  room.inputs.exposure = report;
  room.run(0.5);
  EXPECT_EQ(room.machine().air_kerma_mgy, 0.25);
  EXPECT_EQ(room.machine().dap_mgy_cm2, 30.0);
  EXPECT_NEAR(room.machine().hand_in_beam_s, 1.0 / 7.5, 1e-12);
  EXPECT_EQ(room.machine().technique, report.next) << "what automatic exposure asks for";
  report.frame = 2;  // not fired
  room.inputs.exposure = report;
  room.run(0.1);
  EXPECT_EQ(room.machine().air_kerma_mgy, 0.25);
  room.inputs.fluoroscope.pedal = true;
  room.run(0.002);
  EXPECT_EQ(room.machine().last_technique, report.next);
  EXPECT_EQ(room.machine().air_kerma_mgy, 0.5);
  report.frame = 1;  // of before
  room.inputs.exposure = report;
  room.run(0.1);
  EXPECT_EQ(room.machine().air_kerma_mgy, 0.5);
}

TEST(Fluoroscope, WhatAReportCannotMeanIsNotAddedUp) {
  for (const double bad : {kNan, -1.0, kInfinity, 1e9}) {
    Room room;
    room.inputs.fluoroscope.pedal = true;
    room.run(0.001);
    room.inputs.exposure = {1, bad, 1.0, {kNan, kInfinity, -5.0}, true};
    room.run(0.01);
    EXPECT_EQ(room.machine().air_kerma_mgy, 0.0);
    EXPECT_EQ(room.machine().dap_mgy_cm2, 0.0);
    EXPECT_EQ(room.machine().reported, 1U);
    EXPECT_TRUE(std::isfinite(room.machine().technique.kv) && std::isfinite(room.machine().technique.ma));
    EXPECT_GT(room.machine().technique.pulse_ms, 0.0);
  }
}

TEST(Fluoroscope, TechniqueIsKeptWithinTheMachine) {
  Room room;
  room.inputs.fluoroscope.automatic_exposure = false;
  room.inputs.fluoroscope.kv = 500.0;
  room.inputs.fluoroscope.ma = 1e6;
  room.run(0.001);
  EXPECT_EQ(room.machine().technique, (cases::Technique{120.0, 250.0, 8.0}));
  room.inputs.fluoroscope.kv = 63.0;
  room.inputs.fluoroscope.ma = kNan;
  room.run(0.001);
  EXPECT_EQ(room.machine().technique, (cases::Technique{63.0, 250.0, 8.0})) << "what is no number asks nothing";
}

TEST(Fluoroscope, SpendsWhileMovingAndCountsViewsAtRest) {
  Room room;
  room.inputs.fluoroscope.pulse_rate = 2;
  room.inputs.fluoroscope.pedal = true;
  room.run(1.0);
  EXPECT_EQ(room.machine().views.count, 1);
  room.inputs.fluoroscope.lao_speed = 1.0;
  room.run(1.2);
  EXPECT_EQ(room.machine().views.count, 1) << "no view while it moves";
  EXPECT_NEAR(room.machine().beam_while_moving_s, 1.2, 0.07);
  room.inputs.fluoroscope.lao_speed = 0.0;
  room.run(1.0);
  EXPECT_EQ(room.machine().views.count, 2);
  EXPECT_NEAR(room.machine().views.widest_deg, 30.0, 1e-6);
}

TEST(Fluoroscope, TheCollimatedShareIsWeightedByTime) {
  Room room;
  room.inputs.fluoroscope.pedal = true;
  room.run(4.0);  // 30 pulses, open
  room.inputs.fluoroscope.collimator = {0.5, 0.4};
  room.run(4.0);  // 30 pulses with a fifth of the field
  EXPECT_NEAR(room.machine().collimated_share(), 0.4, 1e-9);
  room.inputs.fluoroscope.collimator = {-3.0, kNan};
  room.run(0.001);
  EXPECT_EQ(room.machine().collimator, (cases::Collimator{cases::kCollimatorMin, 0.4}));
}

TEST(Fluoroscope, NonsenseNeitherMovesNorBreaksIt) {
  Room room;
  room.inputs.fluoroscope = {true, kNan,  kInfinity, -kInfinity, {kNan, kInfinity, 1e300}, {kNan, kInfinity}, -9999,
                             77,   false, kNan,      kInfinity};
  room.run(20.0);
  const cases::FluoroscopyState& machine = room.machine();
  EXPECT_EQ(machine.arm.lao_deg, 0.0);
  EXPECT_EQ(machine.arm.cranial_deg, 0.0) << "infinity is no speed";
  EXPECT_EQ(machine.arm.sid_mm, 1100.0);
  EXPECT_EQ(machine.arm.isocentre_lps_mm.x, 0.0);
  EXPECT_EQ(machine.arm.isocentre_lps_mm.y, 0.0);
  EXPECT_NEAR(machine.arm.isocentre_lps_mm.z, 400.0, 1e-9) << "a number too large is full speed";
  EXPECT_EQ(machine.magnification, 0);
  EXPECT_EQ(machine.pulse_rate, 2);
  EXPECT_EQ(machine.technique, (cases::Technique{}));
}

TEST(Fluoroscope, LetGoOfTheNeedleStays) {
  Room room;
  room.inputs.needle.position_lps_mm = {1, 2, 3};
  room.run(0.001);
  room.inputs.fluoroscope.hand_away = true;
  room.inputs.needle.position_lps_mm = {50, 60, 70};
  room.inputs.needle.axis = {1, 0, 0};
  room.inputs.fire = true;
  room.run(0.1);
  EXPECT_EQ(room.state.needle.tip_lps_mm, glm::dvec3(1, 2, 3));
  EXPECT_EQ(room.state.needle.direction, glm::dvec3(0, 0, 1));
  EXPECT_FALSE(room.state.fire.fired) << "nobody is there to pull the trigger";
  room.inputs.fluoroscope.hand_away = false;
  room.run(0.001);
  EXPECT_EQ(room.state.needle.tip_lps_mm, glm::dvec3(50, 60, 70));
  EXPECT_TRUE(room.state.fire.fired);
}

TEST(Fluoroscope, ACaseOfAnotherModalityDoesNotTouchIt) {
  Room with, without;
  with.scene.picture.modality = without.scene.picture.modality = cases::Modality::mpr;
  with.inputs.fluoroscope = {true, 1.0, 1.0, 1.0, glm::dvec3(1.0), {0.5, 0.5}, 2, 2, false, 90.0, 90.0, true};
  with.inputs.exposure = {1, 1.0, 1.0, {}, true};
  base::Rng rng(6);
  for (int i = 0; i < 200; ++i) {
    with.inputs.needle.position_lps_mm = without.inputs.needle.position_lps_mm = glm::dvec3(rng.normal());
    with.run(0.001);
    without.run(0.001);
    ASSERT_EQ(with.state.needle.tip_lps_mm, with.inputs.needle.position_lps_mm);
    ASSERT_EQ(cases::state_hash(with.state, 0), cases::state_hash(without.state, 0));
  }
  EXPECT_FALSE(with.machine().in_use);
  EXPECT_EQ(with.machine().frames, 0U);
}

TEST(Fluoroscope, MakesNoAllocation) {
  Room room;
  room.inputs.fluoroscope.pedal = true;
  room.inputs.fluoroscope.lao_speed = 0.3;
  const long start = fixtures::allocations();
  room.run(2.0);
  EXPECT_EQ(fixtures::allocations(), start);
  EXPECT_GT(room.pulses, 10);
}

}  // namespace
}  // namespace seldinger::engine
