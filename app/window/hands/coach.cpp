#include "app/window/hands/coach.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>
#include <numbers>

#include "app/window/hands/hand_ways.h"
#include "sim/devices/hands/turning.h"
#include "sim/imaging/probe.h"

namespace seldinger::app {
namespace {

using devices::HeldTool;

// A probe that lies on is pressed so far; what is aligned, by judgement: well within the ball of a drill.
constexpr double kPressedMm = 1.0, kInPlaneMm = 2.0, kEntryInPlaneMm = 3.0, kAtEntryMm = 6.0, kAimedDeg = 3.0;
constexpr double kMiddleMm = 5.0;     // about its middle a probe is turned without losing the target
constexpr double kFarMm = 30.0;       // from the entry, further than a target is looked for
constexpr double kAboveCosine = 0.8;  // of a view to straight down on a block, which lies as a supine patient does
constexpr double kUnseenMm = 8.0;     // so deep a tip is to be seen
constexpr double kFoundMm = 0.5;      // a tip so far off the plane is found: a linear probe's slice is 1.5 mm thick
// A tip that beams meet further off square than this may be lost (docs/decisions/0106); how squarely they are to
// meet it, and by how much a probe is rocked at once.
constexpr double kSteepDeg = 35.0, kSquareDeg = 30.0, kMostRockedDeg = 10.0;
constexpr double kThereShare = 0.5, kPassedShare = 0.8;  // of the target's radius

template <typename... Values>
std::string told(const char* words, Values... values) {
  char text[240];
  std::snprintf(text, sizeof text, words, values...);
  return text;
}

double degrees(double rad) {
  return rad * (180.0 / std::numbers::pi);
}

// With numbers, and the way of the hand.
class Hints {
 public:
  Hints(const cases::Case& scene, const Seen& seen, const devices::HandView& view)
      : target_(scene.lesions.front()),
        entry_(scene.planned_entry_lps_mm),
        seen_(seen),
        probe_(seen.moment.state.probe),
        tip_lps_mm_(seen.moment.state.needle.tip_lps_mm),
        needle_{tip_lps_mm_, seen.moment.state.needle.direction, seen.needle_side},
        normal_(glm::cross(probe_.axial, probe_.lateral)),
        face_(imaging::probe_named(scene.picture.probe)),
        skin_(scene.skin_index),
        view_(view) {}

  std::string search() const;   // where to look, as long as that is not about the entry; else empty
  std::string align() const;    // the target is in the picture, and the needle outside
  std::string advance() const;  // the needle is in tissue
  std::string find() const;     // its tip does not show

  // What its hand does, or that it is to be taken first.
  std::string by(HeldTool tool, const std::string& words) const {
    if (seen_.held == tool || seen_.arms.used) return words;
    return std::string("take the ") + (tool == HeldTool::probe ? "probe" : "needle") + " (Tab)";
  }

 private:
  double off_plane_mm(const glm::dvec3& place_lps_mm) const {
    return glm::dot(place_lps_mm - probe_.origin_lps_mm, normal_);
  }
  double along_mm(const glm::dvec3& place_lps_mm) const {
    return glm::dot(place_lps_mm - probe_.origin_lps_mm, probe_.lateral);
  }
  struct Beam {
    glm::dvec3 from_lps_mm, way;
  };
  // The beam that reaches the tip: where the face sends it from, and which way. A curved face's fan out from
  // behind.
  Beam beam() const {
    const double radius_mm = face_ != nullptr ? face_->radius_mm : 0.0;
    if (!(radius_mm > 0.0)) return {probe_.origin_lps_mm + along_mm(tip_lps_mm_) * probe_.lateral, probe_.axial};
    const glm::dvec3 behind_lps_mm = probe_.origin_lps_mm - radius_mm * probe_.axial;
    const glm::dvec3 way_mm = tip_lps_mm_ - behind_lps_mm;
    const glm::dvec3 way = glm::normalize(way_mm - glm::dot(way_mm, normal_) * normal_);
    return {behind_lps_mm + radius_mm * way, way};
  }
  std::string slide_probe(const glm::dvec3& way_lps_mm) const {
    return by(HeldTool::probe, "slide it " + slide_words(way_lps_mm, HeldTool::probe, probe_.axial, view_)) + ".";
  }

  const cases::Lesion& target_;
  std::optional<glm::dvec3> entry_;
  const Seen& seen_;
  const cases::ProbeState& probe_;
  glm::dvec3 tip_lps_mm_;
  cases::ToolPose needle_;
  glm::dvec3 normal_;
  const imaging::Probe* face_;  // as the case has it
  const cases::MeshIndex& skin_;
  const devices::HandView& view_;
};

std::string Hints::search() const {
  if (!entry_) return {};
  const glm::dvec3 way_lps_mm = *entry_ - probe_.origin_lps_mm;
  const double from_mm = glm::length(way_lps_mm - probe_.axial * glm::dot(way_lps_mm, probe_.axial));
  if (from_mm <= kFarMm) return {};
  if (view_.away.y < kAboveCosine) return "Look from above (4): in that view the probe follows your drag.";
  return told("The probe is %.1f mm from the green entry: search around it, but first ", from_mm) +
         slide_probe(way_lps_mm);
}

std::string Hints::align() const {
  const glm::dvec3& target = target_.center_lps_mm;
  const double aside_mm = along_mm(target), of_target_mm = off_plane_mm(target),
               of_entry_mm = off_plane_mm(*entry_);
  if (std::abs(aside_mm) > kMiddleMm)
    return told("The target is %.1f mm beside the picture’s middle: ", std::abs(aside_mm)) +
           slide_probe(aside_mm * probe_.lateral);
  const std::string misses = told(
      "The picture’s plane misses the target’s middle by %.1f mm and the green entry by "
      "%.1f mm: ",
      std::abs(of_target_mm), std::abs(of_entry_mm));
  if (std::abs(of_target_mm) > kInPlaneMm) return misses + slide_probe(of_target_mm * normal_);
  if (std::abs(of_entry_mm) > kEntryInPlaneMm) {
    const double along = along_mm(*entry_) - aside_mm, across = of_entry_mm - of_target_mm;
    // To either side: a plane has no direction.
    const double turn_rad = std::atan2(along < 0.0 ? -across : across, std::abs(along));
    return misses + by(HeldTool::probe, "rotate it " + rotate_words(turn_rad)) + ".";
  }
  const glm::dvec3 to_entry = *entry_ - tip_lps_mm_, to_target = target - tip_lps_mm_;
  if (const double from_mm = glm::length(to_entry); from_mm > kAtEntryMm)
    return told("The needle’s tip is %.1f mm from the green entry: ", from_mm) +
           by(HeldTool::needle, "move it " + slide_words(to_entry, HeldTool::needle, needle_.axis, view_)) + ".";
  const glm::dvec3 aim = glm::normalize(to_target);
  const double beside_deg = degrees(glm::length(devices::turn_between(needle_.axis, aim)));
  if (beside_deg > kAimedDeg)
    return told("The needle points %.1f° off the target: ", beside_deg) +
           by(HeldTool::needle, "turn " + aim_words(aim, needle_, view_)) + ".";
  return "The needle is aimed: " + by(HeldTool::needle, "advance it (wheel, or Page Down)") + ".";
}

std::string Hints::advance() const {
  const glm::dvec3 to_middle = target_.center_lps_mm - tip_lps_mm_;
  const double left_mm = glm::dot(to_middle, needle_.axis);
  const double beside_mm = glm::length(to_middle - left_mm * needle_.axis);
  if (beside_mm > kPassedShare * target_.radius_mm)
    return told("The needle’s path misses the target’s middle by %.1f mm: ", beside_mm) +
           by(HeldTool::needle, "pull back to the skin and aim again") + ".";
  if (!seen_.frame->needle_tip && seen_.inserted_mm > kUnseenMm) return find();
  if (!seen_.frame->target) return "Advance only while tip and target are both in the picture.";
  if (left_mm > kThereShare * target_.radius_mm)
    return told("Advance: %.1f mm to the target’s middle: ", left_mm) +
           by(HeldTool::needle, "wheel, or Page Down") + ".";
  if (left_mm < -kThereShare * target_.radius_mm)
    return told("Pull back: %.1f mm too deep: ", -left_mm) + by(HeldTool::needle, "wheel, or Page Up") + ".";
  return "The tip is in the target: say so (Space).";
}

std::string Hints::find() const {
  const double off_mm = off_plane_mm(tip_lps_mm_);
  if (std::abs(off_mm) > kFoundMm)
    return told("Stop: the picture does not show the tip, which is %.1f mm off its plane. Bring the probe to it: ",
                std::abs(off_mm)) +
           slide_probe(off_mm * normal_);
  const Beam at_tip = beam();
  const double along = glm::dot(at_tip.way, needle_.axis),
               steep_deg = degrees(std::asin(std::min(1.0, std::abs(along))));
  if (steep_deg > kSteepDeg) {
    const double by_rad = std::min(kMostRockedDeg, steep_deg - kSquareDeg) / degrees(1.0);
    const double turns = along * glm::dot(glm::cross(normal_, at_tip.way), needle_.axis);  // > 0: steeper
    return told("Beams meet the needle %.0f° off square, and its tip sends too little back: ", steep_deg) +
           by(HeldTool::probe, "rock it " + rock_words(turns > 0.0 ? -by_rad : by_rad)) + ".";
  }
  if (!skin_.empty() && skin_.closest(at_tip.from_lps_mm).distance_mm > 0.0)
    return "The probe’s face has lifted off the skin above the tip: press it on: " +
           by(HeldTool::probe, "wheel over the room, or Page Down") + ".";
  return "The tip is in the picture’s plane, but does not show: " +
         by(HeldTool::needle, "advance a little (wheel, or Page Down)") + ".";
}

std::string align_words() {
  return "Turn the probe until the needle’s path and the target are in one picture, then aim the needle.";
}

std::string advance_words(const Seen& seen) {
  if (!seen.frame->needle_tip && seen.inserted_mm > kUnseenMm)
    return "Stop: the picture does not show the tip. Find it before you advance.";
  if (!seen.frame->target) return "Advance only while tip and target are both in the picture.";
  return "Advance slowly while the picture shows the tip. In the target: Space.";
}

std::string across_words(const Seen& seen) {
  if (!seen.inserted)
    return "The needle must cross the picture: insert it beside the probe, steep enough for the target’s depth.";
  return seen.frame->needle_tip
             ? "The picture shows the tip: slide the probe a little ahead of it, then advance until it shows again."
             : "Advance a little at a time until the picture shows the tip; if it does not, bring the probe back "
               "to it.";
}

}  // namespace

std::string hint_words(const cases::Case& scene, const Seen& seen, int help, const devices::HandView& view) {
  if (help <= 0 || scene.subject != cases::Subject::phantom || scene.lesions.empty() ||
      scene.picture.modality != cases::Modality::ultrasound)
    return {};
  const bool numbers = help > 1;
  if (seen.moment.state.fire.fired) return "You have said so. Finish (F9).";
  if (seen.frozen) return "The picture is frozen: press F to unfreeze it.";
  const Hints hints(scene, seen, view);
  if (!seen.inserted && seen.press_mm < kPressedMm)
    return "Press the probe on: " + hints.by(HeldTool::probe, "wheel over the room, or Page Down") + ".";
  if (!seen.frame || !seen.frame->live) return {};
  if (!seen.inserted && !seen.frame->target) {
    if (const std::string first = numbers ? hints.search() : ""; !first.empty()) return first;
    return "Look for the target: " +
           hints.by(HeldTool::probe,
                    "slide and turn the probe over the gel until the lamp shows that it is in the picture") +
           ".";
  }
  if (scene.approach == cases::Approach::out_of_plane) return across_words(seen);
  if (seen.inserted) return numbers ? hints.advance() : advance_words(seen);
  return numbers && scene.planned_entry_lps_mm ? hints.align() : align_words();
}

}  // namespace seldinger::app
