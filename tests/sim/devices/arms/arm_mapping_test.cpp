// Tests of sim/devices/arms/arm_mapping and haptic_arm: where a device's tool is in the patient.
#include "sim/devices/arms/arm_mapping.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <limits>
#include <numbers>

#include "sim/devices/hands/turning.h"

namespace seldinger::devices {
namespace {

using cases::PatientPosition;
constexpr PatientPosition kPositions[] = {PatientPosition::supine, PatientPosition::prone,
                                          PatientPosition::lateral_left, PatientPosition::lateral_right};

ArmReading reading_at(const glm::dvec3& mm) {
  ArmReading reading;
  reading.position_mm = mm;
  reading.healthy = true;
  return reading;
}

TEST(PatientFromTemplate, UpIsUpTheUserFacesThePatientAndTheEntryIsInReach) {
  const glm::dvec3 entry(30.0, -110.0, 12.0);
  for (const PatientPosition position : kPositions)
    for (const StandsAt stands : {StandsAt::patients_right, StandsAt::patients_left}) {
      const Placement placement = patient_from_template(position, stands, entry);
      EXPECT_NEAR(glm::determinant(placement.rotation), 1.0, 1e-12);
      EXPECT_EQ(placement.scale, 1.0);
      EXPECT_LT(glm::length(placement({0, kEntryAboveMm, 0}) - entry), 1e-12);
      EXPECT_LT(glm::length(placement.rotation * glm::dvec3(0, 1, 0) - cases::upwards(position)), 1e-12);
      const glm::dvec3 right = placement.rotation * glm::dvec3(1, 0, 0);
      EXPECT_EQ(right.z, stands == StandsAt::patients_right ? -1.0 : 1.0) << "LPS +z is to the head";
    }
  // A supine patient's right is LPS −x: there the user stands, towards whom the template's z points.
  const Placement supine = patient_from_template(PatientPosition::supine, StandsAt::patients_right, entry);
  EXPECT_LT(glm::length(supine.rotation * glm::dvec3(0, 0, 1) - glm::dvec3(-1, 0, 0)), 1e-12);
}

TEST(PatientFromTemplate, TheUserStandsOnTheEntrysSide) {
  for (const PatientPosition position : kPositions)
    for (const StandsAt stands : {StandsAt::patients_right, StandsAt::patients_left}) {
      const Placement placement = patient_from_template(position, stands, {});
      const glm::dvec3 towards = placement.rotation * glm::dvec3(0, 0, 1);
      EXPECT_EQ(side_of(towards * 50.0, {}, position), stands);
    }
}

TEST(ArmMapping, PutsAToolWhereCalibrationAndPatientSay) {
  const double quarter = 0.5 * std::numbers::pi;
  Placement calibrated;  // a device turned by a quarter about its y, standing 20 mm aside
  calibrated.rotation = {turned({1, 0, 0}, {0, quarter, 0}), {0, 1, 0}, turned({0, 0, 1}, {0, quarter, 0})};
  calibrated.translation_mm = {20.0, 0.0, 0.0};
  const Placement patient = patient_from_template(PatientPosition::supine, StandsAt::patients_right, {0, -100, 0});
  ArmMapping hand(calibrated, patient);
  ArmReading reading = reading_at({10.0, kEntryAboveMm, 5.0});
  reading.orientation = {{1, 0, 0}, turned({0, 1, 0}, {-quarter, 0, 0}), turned({0, 0, 1}, {-quarter, 0, 0})};
  const cases::ToolPose& pose = hand.advance(reading, true, 0.001);
  // The device's (10, 70, 5) is the template's (20 + 5, 70, −10): 25 mm to the feet, 10 mm from the user, who is on
  // the right.
  EXPECT_LT(glm::length(pose.position_lps_mm - glm::dvec3(10.0, -100.0, -25.0)), 1e-9);
  EXPECT_LT(glm::length(pose.axis - glm::dvec3(0, 1, 0)), 1e-9) << "the stylus' −z was turned down";
  EXPECT_NEAR(glm::dot(pose.axis, pose.side), 0.0, 1e-12);
  EXPECT_TRUE(hand.healthy());
  // Work is the same on both sides: what the patient's force does along a move, the motors do along the hand's.
  const glm::dvec3 force(0.3, -1.2, 0.7), move(0.5, 0.25, -0.75);
  const glm::dvec3 before = pose.position_lps_mm;
  reading.position_mm += move;
  const glm::dvec3 moved = hand.advance(reading, true, 0.001).position_lps_mm - before;
  EXPECT_NEAR(glm::dot(force, moved), glm::dot(hand.device_force(force), move), 1e-12);
}

TEST(ArmMapping, StaysWhereItWasWhileTheDeviceIsLost) {
  ArmMapping hand({}, {});
  hand.advance(reading_at({1, 2, 3}), true, 0.001);
  ArmReading lost = reading_at({50, 60, 70});
  lost.healthy = false;
  EXPECT_EQ(hand.advance(lost, true, 0.001).position_lps_mm, glm::dvec3(1, 2, 3));
  EXPECT_FALSE(hand.healthy());
  ArmReading none = reading_at({std::numeric_limits<double>::quiet_NaN(), 0, 0});
  EXPECT_EQ(hand.advance(none, true, 0.001).position_lps_mm, glm::dvec3(1, 2, 3));
  EXPECT_FALSE(hand.healthy());
}

TEST(ArmMapping, ComesBackWithoutAJumpAndMeltsOnlyOutsideTheBody) {
  ArmMapping hand({}, {});
  const cases::ToolPose before = hand.advance(reading_at({1, 2, 3}), true, 0.001);
  ArmReading lost;
  hand.advance(lost, true, 0.001);
  ArmReading back = reading_at({40, 2, 3});
  const glm::dvec3 turn_rad(0.3, 0.5, -0.4);
  back.orientation = {turned({1, 0, 0}, turn_rad), turned({0, 1, 0}, turn_rad), turned({0, 0, 1}, turn_rad)};
  cases::ToolPose pose = hand.advance(back, false, 0.001);
  EXPECT_LT(glm::length(pose.position_lps_mm - before.position_lps_mm), 1e-12);
  EXPECT_LT(glm::length(pose.axis - before.axis), 1e-12);
  EXPECT_LT(glm::length(pose.side - before.side), 1e-12);
  EXPECT_NEAR(hand.offset_mm(), 39.0, 1e-12);
  back.position_mm.y += 5.0;  // in tissue the hand leads, from there
  pose = hand.advance(back, false, 0.001);
  EXPECT_LT(glm::length(pose.position_lps_mm - before.position_lps_mm - glm::dvec3(0, 5, 0)), 1e-12);
  cases::ToolPose last = pose;
  int ticks = 0;
  while (hand.offset_mm() > 0.0 && ++ticks < 2000) {
    pose = hand.advance(back, true, 0.001);
    ASSERT_LE(glm::length(pose.position_lps_mm - last.position_lps_mm), kMeltMmS * 0.001 + 1e-9);
    ASSERT_LE(glm::length(pose.axis - last.axis), 2.0 * kMeltRadS * 0.001 + 1e-9);
    last = pose;
  }
  EXPECT_NEAR(ticks, 39.0 / kMeltMmS * 1000.0, 1.5);
  for (int i = 0; i < 2000; ++i) pose = hand.advance(back, true, 0.001);
  ArmMapping fresh({}, {});
  const cases::ToolPose straight = fresh.advance(back, true, 0.001);
  EXPECT_LT(glm::length(pose.position_lps_mm - straight.position_lps_mm), 1e-9);
  EXPECT_LT(glm::length(pose.axis - straight.axis), 1e-9);
  EXPECT_LT(glm::length(pose.side - straight.side), 1e-9);
}

// The hand went on meanwhile: the tool stays, and does not leap after it.
TEST(ArmMapping, AnAnswerThatWaitedOutAStallIsNoHandToFollow) {
  ArmMapping hand({}, {});
  const glm::dvec3 before(1, 2, 3);
  ArmReading reading = reading_at(before);
  reading.round_trip_s = 0.001;
  hand.advance(reading, false, 0.001);
  hand.let_go();
  reading.round_trip_s = 0.6;
  for (int i = 0; i < 3; ++i) EXPECT_EQ(hand.advance(reading, false, 0.001).position_lps_mm, before);
  EXPECT_FALSE(hand.healthy());
  reading.position_mm.y += 15.0;
  reading.round_trip_s = 0.001;
  EXPECT_LT(glm::length(hand.advance(reading, false, 0.001).position_lps_mm - before), 1e-12);
  EXPECT_TRUE(hand.healthy());
  reading.round_trip_s = 0.02;  // slow as it always is, it is followed
  hand.let_go();
  int ticks = 0;
  do hand.advance(reading, false, 0.001);
  while (!hand.healthy() && ++ticks < 100);
  EXPECT_NEAR(ticks, 20, 1);
}

TEST(ArmMapping, GoesOnFromWhereSomethingElseLeftTheTool) {
  const cases::ToolPose left{{7, 8, 9}, {0, 1, 0}, {1, 0, 0}};
  for (const bool was_there : {false, true}) {
    ArmMapping hand({}, {});
    if (was_there) {
      hand.advance(reading_at({1, 2, 3}), true, 0.001);
      hand.leave_at(left);
      EXPECT_EQ(hand.advance(reading_at({1, 2, 3}), false, 0.001).position_lps_mm, glm::dvec3(1, 2, 3))
          << "a hand that is there lets nobody else have its tool";
      hand.let_go();
    }
    hand.leave_at(left);
    const cases::ToolPose pose = hand.advance(reading_at({40, 2, 3}), false, 0.001);
    EXPECT_LT(glm::length(pose.position_lps_mm - left.position_lps_mm), 1e-12);
    EXPECT_LT(glm::length(pose.axis - left.axis), 1e-12);
    EXPECT_LT(glm::length(pose.side - left.side), 1e-12);
  }
}

TEST(HapticArm, ForceGoesEvenlyWithinTwentyMilliseconds) {
  EXPECT_EQ(share_of_force(0.0), 1.0);
  EXPECT_EQ(share_of_force(kHoldS), 1.0);
  EXPECT_NEAR(share_of_force(0.5 * (kHoldS + kGoneS)), 0.5, 1e-12);
  EXPECT_EQ(share_of_force(kGoneS), 0.0);
  EXPECT_EQ(share_of_force(1e9), 0.0);
  EXPECT_EQ(share_of_force(std::numeric_limits<double>::quiet_NaN()), 0.0);
  EXPECT_LT(kGoneS, 0.020);
}

TEST(HapticArm, DelayIsToldInWholeTicks) {
  ArmReading reading;
  EXPECT_EQ(delay_ticks(reading, 0.001), 1);
  reading.age_s = 0.0004;
  reading.round_trip_s = 0.0012;
  EXPECT_EQ(delay_ticks(reading, 0.001), 2);
  reading.age_s = std::numeric_limits<double>::infinity();
  EXPECT_GT(delay_ticks(reading, 0.001), 1000);
}

}  // namespace
}  // namespace seldinger::devices
