// Who leads a tool as the words say, by mouse or by key, comes nearer to where it is to be, from every view.
#include "app/window/hands/hand_ways.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <glm/geometric.hpp>
#include <map>
#include <numbers>
#include <string>

#include "sim/base/rng.h"
#include "sim/devices/hands/turning.h"

namespace seldinger::app {
namespace {

using devices::HandAction;
using devices::HeldTool;

const std::map<std::string, HandAction> kKeys = {
    {"D", HandAction::slide_right}, {"A", HandAction::slide_left},      {"W", HandAction::slide_up},
    {"S", HandAction::slide_down},  {"Page Down", HandAction::advance}, {"Page Up", HandAction::withdraw},
    {"I", HandAction::tilt_more},   {"K", HandAction::tilt_less},       {"L", HandAction::rock_more},
    {"J", HandAction::rock_less},   {"O", HandAction::rotate_more},     {"U", HandAction::rotate_less}};

double amount_in(const std::string& words) {
  return std::strtod(words.c_str() + words.find("by ") + 3, nullptr);
}
bool has(const std::string& words, const char* part) {
  return words.find(part) != std::string::npos;
}
HandAction key_in(const std::string& words) {
  std::string told = words.substr(words.rfind("or ") + 3);
  if (told.starts_with("by ")) told.erase(0, 3);
  const auto key = kKeys.find(told.substr(0, told.find(')')));
  EXPECT_NE(key, kKeys.end()) << words;
  return key == kKeys.end() ? HandAction::fine : key->second;
}

class HandWaysTest : public testing::Test {
 protected:
  glm::dvec3 unit() {
    glm::dvec3 v;
    do v = {random_.uniform() - 0.5, random_.uniform() - 0.5, random_.uniform() - 0.5};
    while (!(glm::length(v) > 0.05));
    return glm::normalize(v);
  }
  devices::HandView any_view() {
    devices::HandView view;
    view.away = unit();
    view.right = glm::normalize(glm::cross(view.away, unit()));
    view.up = glm::cross(view.right, view.away);
    return view;
  }
  cases::ToolPose any_tool() {
    cases::ToolPose pose{{}, unit(), unit()};
    devices::square_up(pose);
    return pose;
  }
  // What the hand then wants of its tool.
  devices::HandIntent by_key(const std::string& words, double seconds, const devices::HandView& view, HeldTool tool,
                             const cases::ToolPose& pose) const {
    devices::MouseEvents events;
    events.actions.set(static_cast<std::size_t>(key_in(words)));
    events.elapsed_s = seconds;
    return devices::MouseHands().intent(events, view, tool, pose);
  }
  devices::HandIntent by_mouse(const std::string& words, double px, const devices::HandView& view, HeldTool tool,
                               const cases::ToolPose& pose) const {
    devices::MouseEvents events;
    events.secondary = has(words, "right drag");
    events.middle = has(words, "middle drag");
    events.primary = !events.secondary && !events.middle;
    events.right_px = has(words, "to the right") ? px : has(words, "to the left") ? -px : 0.0;
    events.down_px = has(words, "down by") ? px : has(words, "up by") ? -px : 0.0;
    return devices::MouseHands().intent(events, view, tool, pose);
  }

  base::Rng random_{7};
};

TEST_F(HandWaysTest, AProbeComesNearerAlongTheSkin) {
  int led = 0;
  for (int i = 0; i < 200; ++i) {
    const devices::HandView view = any_view();
    const cases::ToolPose probe = any_tool();
    glm::dvec3 way = 20.0 * unit();
    way -= probe.axis * glm::dot(way, probe.axis);
    const std::string words = slide_words(way, HeldTool::probe, probe.axis, view);
    if (has(words, "from above")) continue;
    ++led;
    for (const devices::HandIntent& intent :
         {by_key(words, amount_in(words) / devices::kKeySlideMmS, view, HeldTool::probe, probe),
          by_mouse(words, amount_in(words) / view.mm_per_pixel, view, HeldTool::probe, probe)}) {
      glm::dvec3 gone = intent.slide_lps_mm;
      gone -= probe.axis * glm::dot(gone, probe.axis);
      EXPECT_LT(glm::length(way - gone), 0.95 * glm::length(way)) << words;
      EXPECT_NEAR(glm::dot(way - gone, gone), 0.0, 0.1 * glm::length(way)) << "no further: " << words;
    }
  }
  EXPECT_GT(led, 150);
}

TEST_F(HandWaysTest, ANeedleInTheAirComesNearerInSpace) {
  const devices::HandView above;
  const cases::ToolPose needle{{}, {0.0, 1.0, 0.0}, {1.0, 0.0, 0.0}};
  for (int i = 0; i < 50; ++i) {
    const glm::dvec3 way = 20.0 * unit();
    const std::string words = slide_words(way, HeldTool::needle, needle.axis, above);
    ASSERT_FALSE(has(words, "from above")) << words;
    if (has(words, "Page")) {
      EXPECT_NEAR(amount_in(words), std::abs(way.y), 0.06) << words;
      EXPECT_EQ(has(words, "on by"), way.y > 0.0) << words;
      continue;
    }
    const glm::dvec3 gone =
        by_mouse(words, amount_in(words) / above.mm_per_pixel, above, HeldTool::needle, needle).slide_lps_mm;
    EXPECT_LT(glm::length(way - gone), 0.85 * glm::length(way)) << words;
  }
}

TEST_F(HandWaysTest, ANeedleIsAimedByMouseAndByKeys) {
  for (int i = 0; i < 200; ++i) {
    const devices::HandView view = any_view();
    const cases::ToolPose needle = any_tool();
    const glm::dvec3 wanted = devices::turned(needle.axis, 0.6 * unit());
    const double before = glm::length(devices::turn_between(needle.axis, wanted));
    if (before < 0.05) continue;
    const std::string words = aim_words(wanted, needle, view);
    const auto left = [&](const devices::HandIntent& intent) {
      const glm::dvec3 turn = intent.turn_lps_rad + devices::in_space(intent.turn_own_rad, needle);
      return glm::length(devices::turn_between(devices::turned(needle.axis, turn), wanted));
    };
    EXPECT_LT(left(by_key(words, 0.5 * before / devices::kKeyTurnRadS, view, HeldTool::needle, needle)),
              0.85 * before)
        << words;
    if (has(words, "from above")) continue;
    const double px = 0.5 * amount_in(words) / 180.0 * std::numbers::pi / devices::kRadPerPixel;
    EXPECT_LT(left(by_mouse(words, px, view, HeldTool::needle, needle)), 0.97 * before) << words;
  }
}

TEST_F(HandWaysTest, AProbeIsRotatedAboutItsAxis) {
  for (const double by_rad : {0.7, -0.3}) {
    const std::string words = rotate_words(by_rad);
    EXPECT_NEAR(by_key(words, std::abs(by_rad) / devices::kKeyTurnRadS, {}, HeldTool::probe, {}).turn_own_rad.z,
                by_rad, 1e-9);
    EXPECT_NEAR(by_mouse(words, std::abs(by_rad) / devices::kRadPerPixel, {}, HeldTool::probe, {}).turn_own_rad.z,
                by_rad, 1e-9)
        << words;
  }
}

TEST_F(HandWaysTest, AProbeIsRockedInItsPlane) {
  for (const double by_rad : {0.2, -0.1}) {
    const cases::ToolPose probe = any_tool();
    const glm::dvec3 normal = glm::cross(probe.axis, probe.side);
    const glm::dvec3 wanted = std::cos(by_rad) * probe.axis + std::sin(by_rad) * glm::cross(normal, probe.axis);
    const std::string words = rock_words(by_rad);
    for (const devices::HandIntent& intent :
         {by_key(words, std::abs(by_rad) / devices::kKeyTurnRadS, {}, HeldTool::probe, probe),
          by_mouse(words, std::abs(by_rad) / devices::kRadPerPixel, {}, HeldTool::probe, probe)}) {
      const glm::dvec3 axis = devices::turned(probe.axis, devices::in_space(intent.turn_own_rad, probe));
      EXPECT_LT(glm::length(axis - wanted), 1e-6) << words;
    }
  }
}

}  // namespace
}  // namespace seldinger::app
