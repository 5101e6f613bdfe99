#include "sim/devices/hands/probe_on_skin.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "sim/base/vectors.h"
#include "sim/devices/hands/turning.h"

namespace seldinger::devices {
namespace {

// Small beside any curve of a body.
constexpr double kSlideStepMm = 1.0;
// A place that is further than this many steps is over another fold of the skin.
constexpr double kMostJump = 3.0;
constexpr double kSkinLookMm = 200.0;
// Where the distance field is asked: well above the triangles, below the next fold.
constexpr double kAboveMm = 10.0;

}  // namespace

glm::dvec3 face_normal(const cases::MeshIndex& skin, const glm::dvec3& at_lps_mm, const glm::dvec3& outwards,
                       std::uint32_t hint) noexcept {
  constexpr int kAround = 8;
  const base::Perpendiculars across = base::perpendiculars(outwards);
  const glm::dvec3 above = at_lps_mm + outwards * kAboveMm;
  glm::dvec3 sum(0.0);
  for (int i = 0; i <= kAround; ++i) {
    const double angle_rad = 2.0 * std::numbers::pi * i / kAround;
    const glm::dvec3 p =
        i == kAround ? above
                     : above + (across.u * std::cos(angle_rad) + across.v * std::sin(angle_rad)) * kFaceRadiusMm;
    const cases::Closest near = skin.closest_skin(p, hint);
    const glm::dvec3 away = (p - near.point_lps_mm) * (near.distance_mm < 0.0 ? -1.0 : 1.0);
    const double length_mm = glm::length(away);
    if (length_mm > 1e-9) sum += away / length_mm;
  }
  const double length = glm::length(sum);
  return length > 1e-9 ? sum / length : outwards;
}

ProbeOnSkin::ProbeOnSkin(const cases::MeshIndex& skin, const cases::ToolPose& start) : skin_(&skin), pose_(start) {
  square_up(pose_);
  stand();
}

void ProbeOnSkin::stand() noexcept {
  contact_lps_mm_ = pose_.position_lps_mm;
  normal_ = -pose_.axis;
  press_mm_ = 0.0;
  if (skin_->empty()) return;
  const glm::dvec3 behind = pose_.position_lps_mm - pose_.axis * kSkinLookMm;
  const auto hit = skin_->first_hit(behind, pose_.axis, 2.0 * kSkinLookMm);
  if (hit && !hit->cut) {
    contact_lps_mm_ = behind + pose_.axis * hit->distance_mm;
    triangle_ = hit->triangle;
  } else {
    const cases::Closest near = skin_->closest_skin(pose_.position_lps_mm);
    contact_lps_mm_ = near.point_lps_mm;
    triangle_ = near.triangle;
  }
  normal_ = face_normal(*skin_, contact_lps_mm_, skin_->normal(triangle_), triangle_);
  press_mm_ =
      std::clamp(glm::dot(pose_.position_lps_mm - contact_lps_mm_, pose_.axis), kLeastPressMm, kMostPressMm);
  pose_.position_lps_mm = contact_lps_mm_ + pose_.axis * press_mm_;
}

void ProbeOnSkin::slide(const glm::dvec3& by_lps_mm, bool keep_tilt) noexcept {
  glm::dvec3 left_mm = by_lps_mm - normal_ * glm::dot(by_lps_mm, normal_);
  while (!skin_->empty()) {
    const double length_mm = glm::length(left_mm);
    if (!(length_mm > 1e-12)) break;
    const double step_mm = std::min(length_mm, kSlideStepMm);
    const glm::dvec3 along = left_mm / length_mm;
    const cases::Closest near = skin_->closest_skin(contact_lps_mm_ + along * step_mm, triangle_);
    if (glm::length(near.point_lps_mm - contact_lps_mm_) > kMostJump * step_mm) break;
    contact_lps_mm_ = near.point_lps_mm;
    triangle_ = near.triangle;
    const glm::dvec3 normal = face_normal(*skin_, contact_lps_mm_, normal_, triangle_);
    if (!keep_tilt) devices::turn(turn_between(normal_, normal), pose_);
    normal_ = normal;
    left_mm = along * (length_mm - step_mm);
    left_mm -= normal_ * glm::dot(left_mm, normal_);
  }
  pose_.position_lps_mm = contact_lps_mm_ + pose_.axis * press_mm_;
}

void ProbeOnSkin::turn(const glm::dvec3& by_rad) noexcept {
  cases::ToolPose wanted = pose_;
  devices::turn(by_rad, wanted);
  const glm::dvec3 tilt_rad = turn_between(-normal_, wanted.axis);
  const double most_rad = std::max(kMostProbeTiltRad, glm::length(turn_between(-normal_, pose_.axis)));
  if (glm::length(tilt_rad) > most_rad)
    devices::turn(turn_between(wanted.axis, turned(-normal_, limited(tilt_rad, most_rad))), wanted);
  pose_ = wanted;
  pose_.position_lps_mm = contact_lps_mm_ + pose_.axis * press_mm_;
}

double ProbeOnSkin::press(double by_mm) noexcept {
  const double before_mm = press_mm_;
  press_mm_ = std::clamp(press_mm_ + by_mm, kLeastPressMm, kMostPressMm);
  pose_.position_lps_mm = contact_lps_mm_ + pose_.axis * press_mm_;
  return press_mm_ - before_mm;
}

bool ProbeOnSkin::approach(const ProbeOnSkin& goal, double most_mm, double most_rad) noexcept {
  constexpr double kThereMm = 0.1;
  const glm::dvec3 way_mm = goal.contact_lps_mm_ - contact_lps_mm_;
  const glm::dvec3 tip_rad = turn_between(pose_.axis, goal.pose_.axis);
  slide(limited(way_mm, most_mm), true);
  press(std::clamp(goal.press_mm_ - press_mm_, -most_mm, most_mm));
  devices::turn(limited(tip_rad, most_rad), pose_);
  const double spin_rad = glm::dot(turn_between(pose_.side, goal.pose_.side), pose_.axis);
  devices::turn(pose_.axis * std::clamp(spin_rad, -most_rad, most_rad), pose_);
  pose_.position_lps_mm = contact_lps_mm_ + pose_.axis * press_mm_;
  const bool there = glm::length(goal.contact_lps_mm_ - contact_lps_mm_) <= std::min(kThereMm, most_mm) &&
                     std::abs(goal.press_mm_ - press_mm_) <= kThereMm && glm::length(tip_rad) <= most_rad &&
                     std::abs(spin_rad) <= most_rad;
  if (there) *this = goal;
  return there;
}

}  // namespace seldinger::devices
