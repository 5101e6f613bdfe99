// Tests of sim/devices/arms/haply_json.
#include "sim/devices/arms/haply_json.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "sim/base/vectors.h"
#include "sim/devices/hands/turning.h"
#include "tests/fixtures/mutate.h"
#include "tests/fixtures/outcomes.h"

namespace seldinger::devices {
namespace {

// As the service writes it (docs.haply.co), with things in it that we do not read.
constexpr const char* kFirst =
    R"({"inverse3":[{"device_id":"04BA","config":{"handedness":"right"},"status":{"calibrated":true},)"
    R"("state":{"cursor_position":{"x":0.0412,"y":-0.2061,"z":0.173},"cursor_velocity":{"x":0.0,"y":0.0,"z":0.0}}}],)"
    R"("wireless_verse_grip":[{"device_id":"61576","state":{"orientation":{"x":0.0,"y":0.0,"z":0.70710678,"w":0.70710678},)"
    R"("hall":7,"battery_level":0.81,"buttons":{"a":true,"b":false,"c":true}}}]})";

glm::dmat3 turned_by(const glm::dvec3& turn_rad) {
  return {turned({1, 0, 0}, turn_rad), turned({0, 1, 0}, turn_rad), turned({0, 0, 1}, turn_rad)};
}

double difference(const glm::dmat3& a, const glm::dmat3& b) {
  double most = 0.0;
  for (int i = 0; i < 3; ++i) most = std::max(most, glm::length(a[i] - b[i]));
  return most;
}

TEST(HaplyJson, ReadsWhatTheServiceWrites) {
  const auto message = haply_message(kFirst);
  ASSERT_TRUE(message);
  ASSERT_EQ(message->arms.size(), 1U);
  EXPECT_EQ(message->arms[0].id, "04BA");
  EXPECT_EQ(message->arms[0].handedness, "right");
  EXPECT_EQ(*message->arms[0].position_m, glm::dvec3(0.0412, -0.2061, 0.173));
  ASSERT_EQ(message->grips.size(), 1U);
  EXPECT_LT(difference(*message->grips[0].orientation, turned_by({0, 0, 1.5707963267948966})), 1e-8);
  EXPECT_EQ(message->grips[0].buttons.to_ulong(), 5UL);
}

TEST(HaplyJson, CommandsAreAsTheServiceWantsThem) {
  EXPECT_EQ(text_of(std::vector<HaplyForce>{{"04BA", {0.5, 0.0, -1.25}}}),
            R"({"inverse3":[{"device_id":"04BA","commands":{"set_cursor_force":{"values":)"
            R"({"x":0.5,"y":0.0,"z":-1.25}}}}]})");
  const auto forces = haply_forces(text_of(std::vector<HaplyForce>{{"a", {1, 2, 3}}, {"b", {4, 5, 6}}}));
  ASSERT_TRUE(forces);
  ASSERT_EQ(forces->size(), 2U);
  EXPECT_EQ((*forces)[1].id, "b");
  EXPECT_EQ((*forces)[1].force_n, glm::dvec3(4, 5, 6));
}

TEST(HaplyJson, OrientationsComeBackWhateverTheyAre) {
  base::Rng rng(11);
  for (int i = 0; i < 2000; ++i) {
    const auto any = [&] { return 6.3 * (rng.uniform() - 0.5); };
    const glm::dmat3 wanted = turned_by({any(), any(), any()});
    HaplyMessage message;
    message.grips.push_back({"g", wanted, {}});
    const auto back = haply_message(text_of(message));
    ASSERT_TRUE(back && back->grips.size() == 1 && back->grips[0].orientation);
    ASSERT_LT(difference(*back->grips[0].orientation, wanted), 1e-12);
  }
}

TEST(HaplyJson, WhatCannotBeUsedIsLeftOut) {
  const auto arm = [](const std::string& state) {
    return haply_message(R"({"inverse3":[{"device_id":"a","state":)" + state + "}]}");
  };
  EXPECT_TRUE(arm(R"({"cursor_position":{"x":0.1,"y":0.2,"z":0.3}})")->arms[0].position_m);
  for (const char* bad :
       {R"({"cursor_position":{"x":0.1,"y":0.2}})", R"({"cursor_position":{"x":"0.1","y":0,"z":0}})",
        R"({"cursor_position":{"x":1e9,"y":0,"z":0}})", R"({"cursor_position":[0,0,0]})",
        R"({"cursor_position":{"x":1e999,"y":0,"z":0}})", "3", "null", "[]"}) {
    const auto message = arm(bad);
    if (message && !message->arms.empty()) {
      EXPECT_FALSE(message->arms[0].position_m) << bad;
    }
  }
  const auto grip = haply_message(
      R"({"wireless_verse_grip":[{"device_id":"g","state":{"orientation":{"x":0,"y":0,"z":0,"w":0},"buttons":7}}]})");
  ASSERT_TRUE(grip && grip->grips.size() == 1);
  EXPECT_FALSE(grip->grips[0].orientation);
  EXPECT_TRUE(grip->grips[0].buttons.none());
  EXPECT_TRUE(haply_message(R"({"inverse3":[{"device_id":17},{"device_id":""},{}, 4, null]})")->arms.empty());
  for (const char* bad : {"", "{", "[]", "17", "\xff\xfe", "null", R"({"inverse3":)"})
    EXPECT_FALSE(haply_message(bad)) << bad;
  EXPECT_EQ(haply_message("{}")->arms.size(), 0U);
}

TEST(HaplyJson, DamageIsReadWithoutHarm) {
  const int rounds = fixtures::fuzz_rounds(20'000);
  base::Rng rng(7);
  const std::string command = text_of(std::vector<HaplyForce>{{"04BA", {0.5, 0.25, -1.25}}});
  int usable = 0;
  fixtures::Outcomes messages, commands;
  for (int i = 0; i < rounds; ++i) {
    std::string text = i % 2 == 0 ? std::string(kFirst) : command;
    fixtures::mutate(text, rng);
    const auto message = haply_message(text);
    messages.add(message);
    if (message) {
      ++usable;
      for (const auto& arm : message->arms)
        if (arm.position_m) {
          ASSERT_TRUE(base::is_finite(*arm.position_m));
          ASSERT_LE(glm::length(*arm.position_m), 1.0);
        }
      for (const auto& grip : message->grips)
        if (grip.orientation) {
          ASSERT_NEAR(glm::determinant(*grip.orientation), 1.0, 1e-9);
        }
    }
    const auto forces = haply_forces(text);
    commands.add(forces);
    for (const auto& force : forces.value_or(std::vector<HaplyForce>{}))
      ASSERT_TRUE(base::is_finite(force.force_n));
  }
  messages.expect_both();
  commands.expect_both();
  EXPECT_GT(usable, rounds / 100) << "some damage leaves JSON: that is what the fields' own checks are for";
  const std::string deep(60'000, '[');
  EXPECT_FALSE(haply_message(deep));
  EXPECT_FALSE(haply_message("{\"inverse3\":" + deep));
}

}  // namespace
}  // namespace seldinger::devices
