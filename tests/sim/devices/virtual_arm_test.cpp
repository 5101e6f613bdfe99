// Tests of sim/devices/virtual_arm.
#include "sim/devices/virtual_arm.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

namespace seldinger::devices {
namespace {

TEST(VirtualArm, SettlesWithinHalfAnEncoderStepOfTheHand) {
  VirtualArm device;
  cases::ToolPose hand;
  device.advance(hand, 0.001);
  hand.position_lps_mm = {10.0, -3.3, 0.7};
  cases::ToolPose reading;
  for (int i = 0; i < 1000; ++i) reading = device.advance(hand, 0.001);
  for (int axis = 0; axis < 3; ++axis)
    EXPECT_NEAR(reading.position_lps_mm[axis], hand.position_lps_mm[axis], 0.5 / 32.0 + 1e-9);
}

TEST(VirtualArm, FollowsAStepAsAFirstOrderLag) {
  VirtualArmOptions options;
  options.max_speed_mm_s = 1e9;
  options.encoder_mm = 1e-9;
  VirtualArm device(options);
  cases::ToolPose hand;
  device.advance(hand, 1e-5);
  hand.position_lps_mm.x = 1.0;
  double reading = 0.0;
  for (int i = 0; i < 2000; ++i) reading = device.advance(hand, 1e-5).position_lps_mm.x;
  EXPECT_NEAR(reading, 1.0 - std::exp(-1.0), 1e-3) << "after one time constant of 20 ms";
}

TEST(VirtualArm, AnArmThatIsThereIsReadAtOnceAndAHandGoesOnFromThere) {
  VirtualArm device;
  cases::ToolPose hand;
  device.advance(hand, 0.001);
  cases::ToolPose read;
  read.position_lps_mm = {64.0, -3.0, 0.01};
  EXPECT_EQ(device.follow(read).position_lps_mm, glm::dvec3(64.0, -3.0, 0.0)) << "no lag, in steps of the encoder";
  const glm::dvec3 next = device.advance(hand, 0.001).position_lps_mm;
  EXPECT_NEAR(next.x, 64.0 - 0.4, 0.04) << "no faster than a hand";
}

TEST(VirtualArm, NeverMovesFasterThanAHand) {
  VirtualArm device;
  cases::ToolPose hand;
  glm::dvec3 last = device.advance(hand, 0.001).position_lps_mm;
  hand.position_lps_mm = {500.0, 0.0, 0.0};
  for (int i = 0; i < 500; ++i) {
    const glm::dvec3 now = device.advance(hand, 0.001).position_lps_mm;
    EXPECT_LE(glm::length(now - last), 0.4 + 1.0 / 32.0 + 1e-12);
    last = now;
  }
}

}  // namespace
}  // namespace seldinger::devices
