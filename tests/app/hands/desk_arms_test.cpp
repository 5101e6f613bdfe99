// Tests of app/hands/desk_arms: which arm holds what where, and that its calls are the servo's.
#include "app/hands/desk_arms.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "app/device_simulation/haply_simulation.h"
#include "tests/fixtures/allocations.h"
#include "tests/fixtures/meshes.h"
#include "tests/fixtures/until.h"

namespace seldinger::app {
namespace {

// A supine patient of 200 mm with a target on his left.
cases::Case patient() {
  cases::Case scene;
  scene.volume = volume::make_volume({20, 20, 20}, glm::dvec3(10.0), glm::dmat3(1.0), {-95.0, -95.0, -95.0});
  scene.skin = fixtures::sphere_mesh({0.0, 0.0, 0.0}, 90.0, 5);
  scene.skin_index = cases::MeshIndex(scene.skin);
  cases::Lesion lesion;
  lesion.center_lps_mm = {40.0, -10.0, 5.0};
  lesion.radius_mm = 6.0;
  scene.lesions.push_back(lesion);
  return scene;
}

std::array<SimulatedArm, 2> still_arms() {
  std::array<SimulatedArm, 2> arms = circling_arms();
  arms[0].at_mm = [](double) { return glm::dvec3(-30, 100, 0); };
  arms[1].at_mm = [](double) { return glm::dvec3(30, 100, 0); };
  return arms;
}

devices::ArmReading reading_at(const glm::dvec3& mm) {
  devices::ArmReading reading;
  reading.position_mm = mm;
  reading.healthy = true;
  return reading;
}

TEST(DeviceHands, TheTemplateLiesAroundTheEntryOnItsSide) {
  cases::Case scene = patient();
  const auto at_entry = [&](const cases::Case& of) {
    return arm_mappings({}, of)[1].advance(reading_at({0, devices::kEntryAboveMm, 0}), true, 0.001);
  };
  // Above the target, at the skin: no entry is planned.
  const cases::ToolPose above = at_entry(scene);
  EXPECT_NEAR(above.position_lps_mm.x, 40.0, 1e-9);
  EXPECT_NEAR(glm::length(above.position_lps_mm), 90.0, 0.2);
  EXPECT_LT(above.position_lps_mm.y, 0.0) << "anterior";
  EXPECT_LT(glm::length(above.side - glm::dvec3(0, 0, 1)), 1e-9) << "from his left, the head is at the right hand";
  scene.planned_entry_lps_mm = glm::dvec3(-50.0, -70.0, 0.0);
  const cases::ToolPose planned = at_entry(scene);
  EXPECT_LT(glm::length(planned.position_lps_mm - *scene.planned_entry_lps_mm), 1e-9);
  EXPECT_LT(glm::length(planned.side - glm::dvec3(0, 0, -1)), 1e-9) << "from his right, the feet are";
}

TEST(DeviceHands, EachArmStandsAsItWasCalibrated) {
  Station station;
  station["left"].calibration.template_from_device.translation_mm = {12.0, 0.0, 0.0};
  auto hands = arm_mappings(station, patient());
  const glm::dvec3 left = hands[0].advance(reading_at({0, 0, 0}), true, 0.001).position_lps_mm;
  const glm::dvec3 right = hands[1].advance(reading_at({12, 0, 0}), true, 0.001).position_lps_mm;
  EXPECT_LT(glm::length(left - right), 1e-9);
}

TEST(DeskArms, HandednessSaysWhichArmHoldsTheNeedle) {
  devices::WebSocketPlace place;
  place.port = 0;
  const auto service = HaplySimulation::start(place, still_arms());
  ASSERT_TRUE(service);
  place.port = (*service)->port();
  const cases::Case scene = patient();
  Station station;  // the ids as a station's file has them, the other way round than the service says by itself
  station["left"].ids = {"sim-right", "sim-grip-right"};
  station["right"].ids = {"sim-left", "sim-grip-left"};
  for (const bool swapped : {false, true})
    for (const haptics::Handedness handedness : {haptics::Handedness::right, haptics::Handedness::left}) {
      DeskArms desk(swapped ? station : Station{}, scene, handedness, place);
      cases::Inputs inputs;
      haptics::HandInputs hands;
      const auto both_are_healthy = [&] {
        desk.read(true, true, 0.001, inputs, hands);
        desk.send({}, 0.001);
        return desk.healthy(haptics::Side::left) && desk.healthy(haptics::Side::right);
      };
      ASSERT_TRUE(fixtures::until(both_are_healthy, fixtures::kPatienceS, 0.001));
      // The user faces him from his left: what is at the user's right is towards the head.
      const bool needle_at_right = inputs.needle.position_lps_mm.z > inputs.probe.position_lps_mm.z;
      EXPECT_EQ(needle_at_right, (handedness == haptics::Handedness::right) != swapped);
      EXPECT_NEAR(std::abs(inputs.needle.position_lps_mm.z - inputs.probe.position_lps_mm.z), 60.0, 1.0);
      const auto right = static_cast<std::size_t>(haptics::Side::right);
      EXPECT_EQ(hands[right].tool,
                handedness == haptics::Handedness::right ? haptics::Tool::needle : haptics::Tool::probe);
      EXPECT_GE(hands[right].delay_ticks, 1);
      EXPECT_FALSE(inputs.fire);
      const long before = fixtures::allocations_of_this_thread();
      for (int i = 0; i < 100; ++i) {
        desk.read(true, true, 0.001, inputs, hands);
        desk.send({}, 0.001);
      }
      EXPECT_EQ(fixtures::allocations_of_this_thread(), before);
    }
}

}  // namespace
}  // namespace seldinger::app
