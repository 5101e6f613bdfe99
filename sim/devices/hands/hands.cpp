#include "sim/devices/hands/hands.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "sim/base/check.h"
#include "sim/base/vectors.h"
#include "sim/devices/hands/turning.h"

namespace seldinger::devices {
namespace {

constexpr double kLookMm = 300.0;
// A needle comes to a guide so far above the skin.
constexpr double kGuideAboveMm = 10.0;

// Takes from `pending` what may be done in a tick, and forgets what is more than kPendingS of it.
glm::dvec3 take(glm::dvec3& pending, double most_per_s, double elapsed_s) noexcept {
  pending = limited(pending, most_per_s * std::max(kPendingS, elapsed_s));
  const glm::dvec3 now = limited(pending, most_per_s * elapsed_s);
  pending -= now;
  return now;
}
double take(double& pending, double most_per_s, double elapsed_s) noexcept {
  const double keep = most_per_s * std::max(kPendingS, elapsed_s), most = most_per_s * elapsed_s;
  pending = std::clamp(pending, -keep, keep);
  const double now = std::clamp(pending, -most, most);
  pending -= now;
  return now;
}

bool moves(const HandIntent& intent) noexcept {
  return intent.slide_lps_mm != glm::dvec3(0.0) || intent.turn_lps_rad != glm::dvec3(0.0) ||
         intent.turn_own_rad != glm::dvec3(0.0) || intent.advance_mm != 0.0;
}

bool finite(const HandIntent& intent) noexcept {
  return base::is_finite(intent.slide_lps_mm) && base::is_finite(intent.turn_lps_rad) &&
         base::is_finite(intent.turn_own_rad) && std::isfinite(intent.advance_mm);
}

}  // namespace

double share_against(double axial_force_n, double wanted_mm, double half_n) noexcept {
  if (!std::isfinite(axial_force_n)) return 0.0;
  const double against_n = std::max(0.0, wanted_mm > 0.0 ? axial_force_n : -axial_force_n);
  return 1.0 / (1.0 + against_n / half_n);
}

HandsStart start_over(const cases::MeshIndex& skin, const glm::dvec3& entry_lps_mm, const glm::dvec3& target_lps_mm,
                      bool in_plane, bool mirrored) {
  const glm::dvec3 way = target_lps_mm - entry_lps_mm;
  CHECK(glm::dot(way, way) > 0.0);
  const glm::dvec3 inwards = glm::normalize(way);
  HandsStart start;
  start.needle = {entry_lps_mm - inwards * kStartAboveMm, inwards, base::perpendiculars(inwards).u};
  const cases::Closest near = skin.closest_skin(entry_lps_mm);
  glm::dvec3 outwards =
      skin.empty() ? -inwards : face_normal(skin, near.point_lps_mm, skin.normal(near.triangle), near.triangle);
  // From the entry to above the target; straight down there is no such way, and any will do.
  glm::dvec3 beside = inwards - outwards * glm::dot(inwards, outwards);
  constexpr double kStraight = 0.02;
  if (glm::length(beside) > kStraight) {
    beside = glm::normalize(beside);
  } else {
    outwards = -inwards;
    beside = base::perpendiculars(outwards).u * (mirrored ? -1.0 : 1.0);
  }
  const glm::dvec3 above = entry_lps_mm + beside * kProbeBesideMm + outwards * kLookMm;
  const auto hit = skin.empty() ? std::nullopt : skin.first_hit(above, -outwards, 2.0 * kLookMm);
  start.probe.position_lps_mm = hit && !hit->cut ? above - outwards * hit->distance_mm
                                : skin.empty()   ? entry_lps_mm + beside * kProbeBesideMm
                                                 : skin.closest_skin(above - outwards * kLookMm).point_lps_mm;
  const glm::dvec3 across = glm::cross(outwards, beside);  // of the plane that holds entry and target
  if (in_plane) {
    const glm::dvec3 down =
        hit ? -face_normal(skin, start.probe.position_lps_mm, outwards, hit->triangle) : inwards;
    start.probe.axis = glm::normalize(down - across * glm::dot(down, across));
    start.probe.side = glm::cross(across, -start.probe.axis) * (mirrored ? -1.0 : 1.0);
  } else {
    start.probe.axis = glm::normalize(target_lps_mm - start.probe.position_lps_mm);
    start.probe.side = across * (mirrored ? -1.0 : 1.0);
  }
  square_up(start.probe);
  return start;
}

Hands::Hands(const cases::MeshIndex& skin, const HandsStart& start, const HandsSettings& settings)
    : skin_(&skin),
      start_(start),
      settings_(settings),
      needle_(skin, start.needle, settings.needle_length_mm),
      probe_(skin, start.probe),
      probe_start_(probe_) {}

void Hands::advance(const HandIntent& intent, const AxialForces& forces, double elapsed_s) noexcept {
  if (!(elapsed_s > 0.0) || !finite(intent)) return;
  press_buttons(intent);
  if (returning_ && moves(intent)) returning_ = false;
  take_up(intent);
  if (returning_)
    go_back(elapsed_s);
  else if (held_ == HeldTool::needle)
    move_needle(forces, elapsed_s);
  else
    move_probe(forces, elapsed_s);
  if (guided_ && !returning_) follow_guide(elapsed_s);
}

void Hands::press_buttons(const HandIntent& intent) noexcept {
  fire_ = intent.fire;
  keep_tilt_ = intent.keep_tilt;
  if (intent.freezes % 2 != 0) frozen_ = !frozen_;
  if (settings_.has_probe && intent.swaps % 2 != 0) {
    held_ = held_ == HeldTool::needle ? HeldTool::probe : HeldTool::needle;
    pending_slide_mm_ = pending_turn_rad_ = glm::dvec3(0.0);
    pending_advance_mm_ = 0.0;
  }
  if (intent.guides % 2 != 0) {
    ++guides_asked_;
    // A needle in tissue is not brought to another line.
    guided_ = !guided_ && settings_.has_guide && !needle_.inserted();
    in_guide_ = false;
    guide_side_ = glm::dot(needle().position_lps_mm - probe().position_lps_mm, probe().side) > 0.0 ? 1.0 : -1.0;
  }
  if (intent.resets > 0) {
    returning_ = true;
    guided_ = in_guide_ = false;
    pending_slide_mm_ = pending_turn_rad_ = glm::dvec3(0.0);
    pending_advance_mm_ = 0.0;
  }
}

void Hands::take_up(const HandIntent& intent) noexcept {
  glm::dvec3 slide_mm = intent.slide_lps_mm;
  double advance_mm = intent.advance_mm;
  const cases::ToolPose& pose = held_pose();
  const bool slides_freely = held_ == HeldTool::needle && !needle_.inserted() && !in_guide_;
  if (!slides_freely && (intent.in_space || (held_ == HeldTool::needle && in_guide_))) {
    const double along_mm = glm::dot(slide_mm, pose.axis);
    slide_mm -= pose.axis * along_mm;
    advance_mm += along_mm;
  }
  pending_slide_mm_ += slide_mm;
  pending_turn_rad_ += intent.turn_lps_rad + in_space(intent.turn_own_rad, pose);
  pending_advance_mm_ += advance_mm;
}

void Hands::move_needle(const AxialForces& forces, double elapsed_s) noexcept {
  const glm::dvec3 slide_mm = take(pending_slide_mm_, kSlideMmS, elapsed_s);
  const glm::dvec3 turn_rad = take(pending_turn_rad_, kTurnRadS, elapsed_s);
  const bool touching =
      needle_.inserted() ||
      (!skin_->empty() && skin_->closest(needle().position_lps_mm).distance_mm < 2.0 * kSkinGapMm);
  double way_mm = take(pending_advance_mm_, touching ? kInsertMmS : kSlideMmS, elapsed_s);
  way_mm *= share_against(forces.needle_n, way_mm, kNeedleHalfN);
  if (guided_ && !in_guide_) return;  // on its way to the guide
  if (!in_guide_) {
    needle_.slide(slide_mm);
    needle_.turn(turn_rad);
  }
  needle_.advance(way_mm);
  if (in_guide_ && !needle_.inserted()) {
    const Line line = guide_line();
    along_guide_mm_ = glm::dot(needle().position_lps_mm - line.from_lps_mm, line.along);
  }
}

void Hands::move_probe(const AxialForces& forces, double elapsed_s) noexcept {
  const glm::dvec3 slide_mm = take(pending_slide_mm_, kSlideMmS, elapsed_s);
  const glm::dvec3 turn_rad = take(pending_turn_rad_, kTurnRadS, elapsed_s);
  double press_mm = take(pending_advance_mm_, kPressMmS, elapsed_s);
  press_mm *= share_against(forces.probe_n, press_mm, kProbeHalfN);
  if (probe_held()) return;
  probe_.slide(slide_mm, keep_tilt_);
  probe_.turn(turn_rad);
  probe_.press(press_mm);
}

Hands::Line Hands::guide_line() const noexcept {
  if (settings_.line) {
    const glm::dvec3 along = glm::normalize(settings_.line->aim_lps_mm - settings_.line->entry_lps_mm);
    return {settings_.line->entry_lps_mm, along, base::perpendiculars(along).u};
  }
  const cases::ToolPose& pose = probe();
  const double angle_rad = settings_.probe_guide.angle_deg * (std::numbers::pi / 180.0);
  return {pose.position_lps_mm + pose.side * (guide_side_ * settings_.probe_guide.offset_mm),
          glm::normalize(pose.axis * std::cos(angle_rad) - pose.side * (guide_side_ * std::sin(angle_rad))),
          glm::cross(pose.axis, pose.side)};
}

std::optional<ProbeGuide> Hands::guide_on_probe() const noexcept {
  if (!guided_ || !on_probe()) return std::nullopt;
  return ProbeGuide{guide_side_ * settings_.probe_guide.offset_mm, settings_.probe_guide.angle_deg};
}

void Hands::follow_guide(double elapsed_s) noexcept {
  if (needle_.inserted()) return;  // its own entry and axis are the line now
  const Line line = guide_line();
  // Where the line meets the skin: from well outside, so that a guide on a pressed probe finds it too.
  const glm::dvec3 outside = line.from_lps_mm - line.along * kLookMm;
  const auto hit = skin_->empty() ? std::nullopt : skin_->first_hit(outside, line.along, 2.0 * kLookMm);
  const double skin_mm = hit ? hit->distance_mm - kLookMm : kLookMm;
  if (in_guide_) {
    along_guide_mm_ = std::min(along_guide_mm_, skin_mm - kSkinGapMm);
    needle_.place({line.from_lps_mm + line.along * along_guide_mm_, line.along, line.side});
    return;
  }
  const glm::dvec3 from_line = needle().position_lps_mm - line.from_lps_mm;
  const double goal_mm = std::min(glm::dot(from_line, line.along), skin_mm - kGuideAboveMm);
  const glm::dvec3 way_mm = line.from_lps_mm + line.along * goal_mm - needle().position_lps_mm;
  const glm::dvec3 turn_rad = turn_between(needle().axis, line.along);
  if (glm::length(way_mm) <= kSlideMmS * elapsed_s && glm::length(turn_rad) <= kTurnRadS * elapsed_s) {
    along_guide_mm_ = goal_mm;
    needle_.place({line.from_lps_mm + line.along * goal_mm, line.along, line.side});
    in_guide_ = true;
    return;
  }
  needle_.slide(limited(way_mm, kSlideMmS * elapsed_s));
  needle_.turn(limited(turn_rad, kTurnRadS * elapsed_s));
}

void Hands::go_back(double elapsed_s) noexcept {
  const double most_mm = kSlideMmS * elapsed_s, most_rad = kTurnRadS * elapsed_s;
  if (needle_.inserted()) {
    needle_.advance(-kInsertMmS * elapsed_s);
    return;
  }
  const glm::dvec3 way_mm = start_.needle.position_lps_mm - needle().position_lps_mm;
  const glm::dvec3 turn_rad = turn_between(needle().axis, start_.needle.axis);
  const bool there = glm::length(way_mm) <= most_mm && glm::length(turn_rad) <= most_rad;
  if (there) {
    needle_.place(start_.needle);
  } else {
    const glm::dvec3 before = needle().position_lps_mm, step_mm = limited(way_mm, most_mm);
    needle_.slide(step_mm);
    needle_.turn(limited(turn_rad, most_rad));
    // Round the body: where it is in the way, outwards.
    if (glm::length(needle().position_lps_mm - before) < 0.5 * glm::length(step_mm)) {
      const cases::Closest near = skin_->closest(before);
      needle_.slide(skin_->normal(near.triangle) * most_mm);
    }
  }
  if (probe_.approach(probe_start_, most_mm, most_rad) && there) returning_ = false;
}

void Hands::say(cases::Inputs& inputs) const noexcept {
  inputs.needle = needle();
  inputs.probe = probe();
  inputs.fire = fire_;
  inputs.freeze = frozen_;
}

void Hands::set_guide(const ProbeGuide& guide) noexcept {
  settings_.line.reset();
  settings_.probe_guide = guide;
  guided_ = in_guide_ = false;
}

void Hands::set_guide(const LineGuide& guide) noexcept {
  settings_.line = guide;
  guided_ = in_guide_ = false;
}

void Hands::let_go() noexcept {
  returning_ = false;
  pending_slide_mm_ = pending_turn_rad_ = glm::dvec3(0.0);
  pending_advance_mm_ = 0.0;
}

void Hands::take_over(const HandsStart& at) noexcept {
  needle_ = NeedleInHand(*skin_, at.needle, settings_.needle_length_mm);
  probe_ = ProbeOnSkin(*skin_, at.probe);
  guided_ = in_guide_ = returning_ = false;
  pending_slide_mm_ = pending_turn_rad_ = glm::dvec3(0.0);
  pending_advance_mm_ = 0.0;
}

}  // namespace seldinger::devices
