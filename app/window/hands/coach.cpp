#include "app/window/hands/coach.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>
#include <numbers>

namespace seldinger::app {
namespace {

// A probe that lies on is pressed so far; what is aligned, by judgement: well within the ball of a drill.
constexpr double kPressedMm = 1.0, kInPlaneMm = 2.0, kEntryInPlaneMm = 3.0, kAtEntryMm = 16.0, kAimedDeg = 6.0;
constexpr double kMiddleMm = 9.0;  // about its middle a probe is turned without losing the target
constexpr double kFarMm = 40.0;    // from the entry, further than a target is looked for
constexpr double kUnseenMm = 8.0;  // so deep a tip is to be seen
constexpr double kThereShare = 0.5, kPassedShare = 0.8;  // of the target's radius

std::string told(const char* words, double number) {
  char text[200];
  std::snprintf(text, sizeof text, words, number);
  return text;
}

double off_plane_mm(const cases::ProbeState& probe, const glm::dvec3& place_lps_mm) {
  return std::abs(glm::dot(place_lps_mm - probe.origin_lps_mm, glm::cross(probe.axial, probe.lateral)));
}

double angle_deg(const glm::dvec3& a, const glm::dvec3& b) {
  return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)) * (180.0 / std::numbers::pi);
}

// The target is in the picture, and the needle outside.
std::string align_words(const cases::Case& scene, const Seen& seen, bool numbers) {
  const cases::State& state = seen.moment.state;
  const glm::dvec3& target = scene.lesions.front().center_lps_mm;
  if (!numbers || !scene.planned_entry_lps_mm)
    return "Turn the probe until the needle’s path and the target lie in one picture, then aim the needle.";
  const glm::dvec3& entry = *scene.planned_entry_lps_mm;
  const double aside_mm = std::abs(glm::dot(target - state.probe.origin_lps_mm, state.probe.lateral));
  if (aside_mm > kMiddleMm)
    return told("The target is %.1f mm beside the picture’s middle: slide the probe along (Tab takes it).",
                aside_mm);
  const double of_target = off_plane_mm(state.probe, target), of_entry = off_plane_mm(state.probe, entry);
  if (of_target > kInPlaneMm || of_entry > kEntryInPlaneMm) {
    char text[240];
    std::snprintf(text, sizeof text,
                  "The picture’s plane misses the target’s middle by %.1f mm and the green entry by %.1f mm: slide "
                  "and turn the probe (Tab takes it).",
                  of_target, of_entry);
    return text;
  }
  const glm::dvec3& tip = state.needle.tip_lps_mm;
  if (const double from_mm = glm::distance(tip, entry); from_mm > kAtEntryMm)
    return told("The needle’s tip is %.1f mm from the green entry: take it there (Tab takes it).", from_mm);
  if (const double beside_deg = angle_deg(state.needle.direction, target - tip); beside_deg > kAimedDeg)
    return told("The needle points %.1f° beside the target: turn it.", beside_deg);
  return "The needle is aimed: push it on (wheel, or Page Down).";
}

std::string advance_words(const cases::Case& scene, const Seen& seen, bool numbers) {
  const cases::State& state = seen.moment.state;
  const cases::Lesion& target = scene.lesions.front();
  const glm::dvec3 to_middle = target.center_lps_mm - state.needle.tip_lps_mm;
  const double left_mm = glm::dot(to_middle, state.needle.direction);
  const double beside_mm = glm::length(to_middle - left_mm * state.needle.direction);
  if (!seen.frame->needle_tip && seen.inserted_mm > kUnseenMm)
    return numbers
               ? told(
                     "Stop: the picture does not show the tip, which is %.1f mm beside its plane. Bring the probe "
                     "to it (Tab takes it).",
                     off_plane_mm(state.probe, state.needle.tip_lps_mm))
               : "Stop: the picture does not show the tip. Find it before you go on.";
  if (!seen.frame->target) return "Go on only while tip and target are both in the picture.";
  if (!numbers) return "Push on slowly while the picture shows the tip. In the target: Space.";
  if (beside_mm > kPassedShare * target.radius_mm && left_mm > target.radius_mm)
    return told("The needle’s path passes the target’s middle by %.1f mm: draw back to the skin and aim again.",
                beside_mm);
  if (left_mm > kThereShare * target.radius_mm) return told("Push on: %.1f mm to the target’s middle.", left_mm);
  if (left_mm < -kThereShare * target.radius_mm) return told("Draw back: %.1f mm too deep.", -left_mm);
  return "The tip is in the target: say so (Space).";
}

std::string across_words(const Seen& seen) {
  if (!seen.inserted)
    return "The needle is to cross the picture: put it in beside the probe, steep enough for the target’s depth.";
  return seen.frame->needle_tip
             ? "The picture shows the tip: slide the probe a little ahead of it, then push on until it shows again."
             : "Push on by little until the picture shows the tip; if it does not, bring the probe back to it.";
}

}  // namespace

std::string hint_words(const cases::Case& scene, const Seen& seen, int help) {
  if (help <= 0 || scene.subject != cases::Subject::phantom || scene.lesions.empty() ||
      scene.picture.modality != cases::Modality::ultrasound)
    return {};
  const bool numbers = help > 1;
  if (seen.moment.state.fire.fired) return "It is said. Finish (F9).";
  if (seen.frozen) return "The picture stands still: F lets it go on.";
  if (!seen.inserted && seen.press_mm < kPressedMm)
    return "Press the probe on: Tab takes it, and the wheel over the room presses.";
  if (!seen.frame || !seen.frame->live) return {};
  if (!seen.inserted && !seen.frame->target) {
    const glm::dvec3& probe = seen.moment.state.probe.origin_lps_mm;
    const double from_mm = scene.planned_entry_lps_mm ? glm::distance(probe, *scene.planned_entry_lps_mm) : 0.0;
    if (numbers && from_mm > kFarMm)
      return told("The probe is %.1f mm from the green entry: slide it there, and look about it.", from_mm);
    return "Look for the target: slide the probe over the gel, and turn it, until the lamp says that it is in the "
           "picture.";
  }
  if (scene.approach == cases::Approach::out_of_plane) return across_words(seen);
  return seen.inserted ? advance_words(scene, seen, numbers) : align_words(scene, seen, numbers);
}

}  // namespace seldinger::app
