#include "app/window/hands/hand_ways.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>
#include <numbers>

#include "sim/devices/hands/turning.h"

namespace seldinger::app {
namespace {

constexpr double kDegrees = 180.0 / std::numbers::pi;
// A way of the hand that does less than this of what is wanted leads nowhere; from above one does more.
constexpr double kLeastShare = 0.4;
constexpr double kFineMm = 2.0;  // less than this takes Shift, by which hands go ten times finer
constexpr const char* kFromAbove = "once you look from above (4)";

struct Way {
  const char *to, *by;
  glm::dvec3 along;  // of a millimetre of the hand
};

std::array<Way, 4> on_screen(const devices::HandView& view) {
  return {{{"to the right", "D", view.right},
           {"to the left", "A", -view.right},
           {"up", "W", view.up},
           {"down", "S", -view.up}}};
}

// The part of `wanted` that lies along what a way of the hand does, and how much of the hand that takes.
struct Led {
  double share = 0.0, amount = 0.0;
};
Led led(const glm::dvec3& wanted, const glm::dvec3& does) {
  const double length = glm::length(does), all = glm::length(wanted);
  if (!(length > kLeastShare) || !(all > 0.0)) return {};
  const double along = glm::dot(wanted, does) / length;
  return {along / all, along / length};
}

template <typename... Values>
std::string filled(const char* words, Values... values) {
  char text[160];
  std::snprintf(text, sizeof text, words, values...);
  return text;
}

}  // namespace

std::string slide_words(const glm::dvec3& way_lps_mm, devices::HeldTool tool, const glm::dvec3& axis,
                        const devices::HandView& view) {
  Led best;
  std::string words = kFromAbove;
  const auto look = [&](const Way& way, const char* hand) {
    const Led one = led(way_lps_mm, way.along);
    if (one.share <= std::max(kLeastShare, best.share)) return;
    best = one;
    words = filled("%s by %.1f mm (%s%s, or %s)", way.to, one.amount, hand,
                   one.amount < kFineMm ? " with Shift" : "", way.by);
  };
  for (Way way : on_screen(view)) {
    if (tool == devices::HeldTool::probe) way.along -= axis * glm::dot(way.along, axis);
    look(way, "drag");
  }
  if (tool == devices::HeldTool::needle) {
    look({"on", "Page Down", axis}, "wheel");
    look({"back", "Page Up", -axis}, "wheel");
  }
  return words;
}

std::string aim_words(const glm::dvec3& direction, const cases::ToolPose& needle, const devices::HandView& view) {
  const glm::dvec3 turn_rad = devices::turn_between(needle.axis, direction);
  // As MouseHands has it: the hub, behind the tip, goes with the mouse.
  const glm::dvec3 hub_way = glm::cross(turn_rad, -needle.axis);
  const double tilt_rad = glm::dot(turn_rad, needle.side),
               rock_rad = glm::dot(turn_rad, glm::cross(needle.axis, needle.side));
  const char* key =
      std::abs(tilt_rad) >= std::abs(rock_rad) ? (tilt_rad > 0.0 ? "I" : "K") : (rock_rad > 0.0 ? "L" : "J");
  Led best;
  std::string words = std::string("it ") + kFromAbove + ", or by " + key;
  for (Way way : on_screen(view)) {
    way.along -= needle.axis * glm::dot(way.along, needle.axis);
    const Led one = led(hub_way, way.along);
    if (one.share <= std::max(kLeastShare, best.share)) continue;
    best = one;
    words = filled("its hub %s by %.0f° (right drag, or %s)", way.to, kDegrees * one.amount, key);
  }
  return words;
}

std::string rotate_words(double by_rad) {
  return filled("by %.0f° (middle drag to the %s, or %s)", kDegrees * std::abs(by_rad),
                by_rad > 0.0 ? "right" : "left", by_rad > 0.0 ? "O" : "U");
}

std::string rock_words(double by_rad) {
  return filled("by %.0f° (right drag to the %s, or %s)", kDegrees * std::abs(by_rad),
                by_rad > 0.0 ? "right" : "left", by_rad > 0.0 ? "L" : "J");
}

}  // namespace seldinger::app
