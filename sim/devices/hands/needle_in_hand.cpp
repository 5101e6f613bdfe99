#include "sim/devices/hands/needle_in_hand.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "sim/base/check.h"
#include "sim/devices/hands/turning.h"

namespace seldinger::devices {

double most_pivot_rad(double inserted_mm) noexcept {
  return inserted_mm > kMostSweepMm ? std::min(kMostPivotRad, std::asin(kMostSweepMm / inserted_mm))
                                    : kMostPivotRad;
}

NeedleInHand::NeedleInHand(const cases::MeshIndex& skin, const cases::ToolPose& start, double length_mm)
    : skin_(&skin), length_mm_(length_mm), pose_(start) {
  CHECK(length_mm > 0.0);
  square_up(pose_);
  settle();
}

void NeedleInHand::settle() noexcept {
  passage_ = cases::start_passage(*skin_, pose_.position_lps_mm, pose_.axis);
  inserted_ = passage_.in_body;
  entry_lps_mm_ = passage_.entry_lps_mm;
  track_ = pose_.axis;
}

double NeedleInHand::inserted_mm() const noexcept {
  return inserted_ ? glm::dot(pose_.position_lps_mm - entry_lps_mm_, pose_.axis) : 0.0;
}

void NeedleInHand::slide(const glm::dvec3& by_lps_mm) noexcept {
  if (inserted_) {
    const glm::dvec3 hub = -pose_.axis * std::max(kLeastLeverMm, length_mm_ - inserted_mm());
    const glm::dvec3 across = by_lps_mm - pose_.axis * glm::dot(by_lps_mm, pose_.axis);
    turn(glm::cross(hub, across) / glm::dot(hub, hub));
    return;
  }
  glm::dvec3 left_mm = by_lps_mm, tip = pose_.position_lps_mm;
  // Along a fold of the skin it is met more than once.
  for (int i = 0; i < 4; ++i) {
    const double length_mm = glm::length(left_mm);
    if (!(length_mm > 0.0)) break;
    const glm::dvec3 along = left_mm / length_mm;
    const auto hit = skin_->empty() ? std::nullopt : skin_->first_hit(tip, along, length_mm + kSkinGapMm);
    if (!hit) {
      tip += left_mm;
      break;
    }
    const double free_mm = std::max(0.0, hit->distance_mm - kSkinGapMm);
    tip += along * free_mm;
    const glm::dvec3 normal = skin_->normal(hit->triangle);
    left_mm = along * (length_mm - free_mm);
    left_mm -= normal * glm::dot(left_mm, normal);
  }
  cases::SkinPassage there = passage_;
  cases::advance_passage(*skin_, tip, there);
  if (there.geometric_inside && !passage_.geometric_inside) return;  // a sideways move never punctures
  passage_ = there;
  pose_.position_lps_mm = tip;
}

void NeedleInHand::turn(const glm::dvec3& by_rad) noexcept {
  cases::ToolPose wanted = pose_;
  devices::turn(by_rad, wanted);
  if (!inserted_) {
    // Not with the shaft into the body.
    if (skin_->empty() || !skin_->first_hit(wanted.position_lps_mm, -wanted.axis, length_mm_)) pose_ = wanted;
    return;
  }
  const double depth_mm = inserted_mm();
  const glm::dvec3 now_rad = turn_between(track_, pose_.axis), wanted_rad = turn_between(track_, wanted.axis);
  // What it is turned already, it may stay.
  const double most_rad = std::max(most_pivot_rad(depth_mm), glm::length(now_rad));
  if (glm::length(wanted_rad) > most_rad)
    devices::turn(turn_between(wanted.axis, turned(track_, limited(wanted_rad, most_rad))), wanted);
  pose_ = wanted;
  pose_.position_lps_mm = entry_lps_mm_ + pose_.axis * depth_mm;
  cases::advance_passage(*skin_, pose_.position_lps_mm, passage_);
}

double NeedleInHand::advance(double by_mm) noexcept {
  if (inserted_) {
    const double depth_mm = inserted_mm();
    double to_mm = std::min(depth_mm + by_mm, std::max(depth_mm, length_mm_));
    if (to_mm <= 0.0) to_mm = std::min(to_mm, -kSkinGapMm);  // out is clear of the skin
    if (to_mm > depth_mm)
      track_ = glm::normalize(track_ + (pose_.axis - track_) * -std::expm1((depth_mm - to_mm) / kTrackMm));
    pose_.position_lps_mm = entry_lps_mm_ + pose_.axis * to_mm;
    cases::advance_passage(*skin_, pose_.position_lps_mm, passage_);
    if (to_mm <= 0.0) inserted_ = false;
    return to_mm - depth_mm;
  }
  double way_mm = by_mm;
  if (by_mm != 0.0 && !skin_->empty() && !passage_.geometric_inside) {
    const glm::dvec3 along = by_mm > 0.0 ? pose_.axis : -pose_.axis;
    const auto hit = skin_->first_hit(pose_.position_lps_mm, along, std::abs(by_mm) + kSkinGapMm);
    // Backwards nothing is punctured, and a cap never; forwards only what it stands at.
    if (hit && (by_mm < 0.0 || hit->cut || hit->distance_mm > 2.0 * kSkinGapMm))
      way_mm = std::copysign(std::min(std::abs(by_mm), std::max(0.0, hit->distance_mm - kSkinGapMm)), by_mm);
  }
  pose_.position_lps_mm += pose_.axis * way_mm;
  cases::advance_passage(*skin_, pose_.position_lps_mm, passage_);
  if (passage_.in_body) {
    inserted_ = true;
    entry_lps_mm_ = passage_.entry_lps_mm;
    track_ = pose_.axis;
  }
  return way_mm;
}

void NeedleInHand::place(const cases::ToolPose& pose) noexcept {
  CHECK(!inserted_);
  pose_ = pose;
  square_up(pose_);
  cases::advance_passage(*skin_, pose_.position_lps_mm, passage_);
}

}  // namespace seldinger::devices
