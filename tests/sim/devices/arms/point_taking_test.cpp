// Tests of sim/devices/arms/point_taking and device_gains.
#include "sim/devices/arms/point_taking.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "sim/devices/arms/arm_mapping.h"

namespace seldinger::devices {
namespace {

constexpr double kTickS = 0.001;

ArmReading at(const glm::dvec3& mm, bool button = false) {
  ArmReading reading;
  reading.position_mm = mm;
  reading.buttons[0] = button;
  reading.healthy = true;
  return reading;
}

// As somebody who holds the stylus still there and presses its button.
void touch(PointTaking& taking, const glm::dvec3& mm) {
  for (int i = 0; i < 50; ++i) taking.advance(at(mm), false, kTickS);
  for (int i = 0; i < 450; ++i) taking.advance(at(mm, true), false, kTickS);
}

TEST(PointTaking, TakesThePointsInTheirOrderAndCalibratesByThem) {
  // A device that stands 10 mm to the right, turned by a quarter about its y.
  Placement stands;
  stands.rotation = {{0, 0, -1}, {0, 1, 0}, {1, 0, 0}};
  stands.translation_mm = {10.0, -4.0, 3.0};
  const Placement device_from_template = inverse_of(stands);
  PointTaking taking;
  std::size_t next = 0;
  for (const TemplatePoint& point : template_points()) {
    ASSERT_EQ(taking.asked(), next++);
    touch(taking, device_from_template(point.template_mm));
  }
  EXPECT_FALSE(taking.asked());
  const auto calibration = calibrate(taking.points());
  ASSERT_TRUE(calibration) << calibration.error().text;
  EXPECT_LT(calibration->residual_max_mm, 1e-9);
  EXPECT_LT(glm::length(calibration->template_from_device.translation_mm - stands.translation_mm), 1e-9);
}

TEST(PointTaking, AHandThatTremblesIsAveragedAndOneThatMovesIsAskedAgain) {
  PointTaking taking;
  taking.advance(at({1, 2, 3}), true, kTickS);
  for (int i = 0; i < 399; ++i) taking.advance(at({1.0 + (i % 2 == 0 ? 0.2 : -0.2), 2, 3}), false, kTickS);
  ASSERT_TRUE(taking.taken_mm()[0]);
  EXPECT_LT(glm::length(*taking.taken_mm()[0] - glm::dvec3(1, 2, 3)), 0.01);
  taking.advance(at({5, 2, 3}), true, kTickS);
  EXPECT_EQ(taking.state(), Taking::reading);
  taking.advance(at({5.6, 2, 3}), false, kTickS);
  EXPECT_EQ(taking.state(), Taking::moved);
  EXPECT_EQ(taking.asked(), 1U);
  for (int i = 0; i < 1000; ++i) taking.advance(at({5.6, 2, 3}), false, kTickS);
  EXPECT_EQ(taking.asked(), 1U) << "nobody said that it stands there";
}

TEST(PointTaking, AnArmThatIsLostGivesNoPoint) {
  PointTaking taking;
  taking.advance(at({1, 2, 3}), true, kTickS);
  ArmReading lost = at({1, 2, 3});
  lost.healthy = false;
  taking.advance(lost, false, kTickS);
  EXPECT_EQ(taking.state(), Taking::lost);
  for (int i = 0; i < 1000; ++i) taking.advance(at({1, 2, 3}), false, kTickS);
  EXPECT_EQ(taking.asked(), 0U) << "it is begun anew";
  touch(taking, {1, 2, 3});
  EXPECT_EQ(taking.asked(), 1U);
}

TEST(PointTaking, OneIsTakenAgainAndTheOptionalOneMayBeLeftOut) {
  PointTaking taking;
  taking.leave_out();
  EXPECT_EQ(taking.asked(), 0U) << "a is required";
  for (int i = 0; i < 4; ++i) touch(taking, glm::dvec3(i, 0, 0));
  ASSERT_EQ(taking.asked(), 4U);
  taking.leave_out();
  EXPECT_EQ(taking.asked(), 5U);
  touch(taking, {5, 0, 0});
  EXPECT_FALSE(taking.asked());
  EXPECT_EQ(taking.points().size(), 5U);
  taking.again(2);
  EXPECT_EQ(taking.asked(), 2U);
  EXPECT_EQ(taking.points().size(), 4U);
}

TEST(PointTaking, AButtonThatIsDownAtTheBeginningTakesNothing) {
  PointTaking taking;
  for (int i = 0; i < 1000; ++i) taking.advance(at({1, 2, 3}, true), false, kTickS);
  EXPECT_EQ(taking.asked(), 0U);
}

TEST(DeviceGains, ForceIsNeverStifferThanTheTissueThatAsksForIt) {
  const glm::dvec3 force(0.0, 3.0, 0.0);
  for (const double scale : {0.5, 1.0, 2.0})
    for (const double share : {0.25, 1.0}) {
      const ArmMapping hand(
          {}, patient_from_template(cases::PatientPosition::supine, StandsAt::patients_right, {}, scale),
          {scale, share, 10.0});
      const double felt = glm::length(hand.device_force(force)) / 3.0;
      EXPECT_LE(felt * scale, 1.0 + 1e-12);
      EXPECT_NEAR(felt, std::min(share, 1.0 / scale), 1e-12);
    }
  const ArmMapping weak({}, {}, {1.0, 1.0, 2.0});
  EXPECT_NEAR(glm::length(weak.device_force(force)), 2.0, 1e-12) << "no more than its most";
  EXPECT_TRUE(is_sound(DeviceGains{}));
  EXPECT_FALSE(is_sound({3.0, 1.0, 10.0}));
  EXPECT_FALSE(is_sound({1.0, 1.5, 10.0}));
  EXPECT_FALSE(is_sound({1.0, 1.0, -1.0}));
}

TEST(DeviceGains, AScaledHandTurnsAboutTheEntryAndItsWayBackIsExact) {
  const glm::dvec3 entry(30.0, -110.0, 12.0);
  Placement stands;
  stands.rotation = {{0, 0, -1}, {0, 1, 0}, {1, 0, 0}};
  stands.translation_mm = {10.0, -4.0, 3.0};
  stands.scale = 1.1;
  ArmMapping hand(stands,
                  patient_from_template(cases::PatientPosition::prone, StandsAt::patients_left, entry, 2.0));
  const cases::ToolPose wanted{entry + glm::dvec3(20, 10, -5), glm::normalize(glm::dvec3(1, 2, 3)), {0, 3, -2}};
  ArmReading reading = hand.reading_of(wanted);
  reading.healthy = true;
  const cases::ToolPose pose = hand.advance(reading, true, kTickS);
  EXPECT_LT(glm::length(pose.position_lps_mm - wanted.position_lps_mm), 1e-9);
  EXPECT_LT(glm::length(pose.axis - wanted.axis), 1e-9);
  EXPECT_LT(glm::length(pose.side - glm::normalize(wanted.side)), 1e-9);
  const ArmReading there = hand.reading_of({entry, wanted.axis, wanted.side});
  EXPECT_NEAR(glm::length(reading.position_mm - there.position_mm), glm::length(glm::dvec3(20, 10, -5)) / 2.2,
              1e-9);
}

}  // namespace
}  // namespace seldinger::devices
