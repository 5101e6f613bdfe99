#include "sim/engine/patient.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace seldinger::engine {
namespace {

using cases::EventKind;

constexpr double kPointingMm = 150.0;  // a needle held nearer than this points at a place on the skin

}  // namespace

Patient::Patient(const cases::Case& scene) : scene_(scene) {
  if (!scene.classes.empty()) voxel_from_lps_ = volume::voxel_from_lps(scene.volume);
}

// Outside, where its way would meet the skin; else the nearest skin.
glm::dvec3 Patient::pointed_at(const cases::NeedleState& needle) const noexcept {
  if (needle.skin.in_body) return needle.skin.entry_lps_mm;
  const auto hit = scene_.skin_index.first_hit(needle.tip_lps_mm, needle.direction, kPointingMm);
  if (hit && !hit->cut) return needle.tip_lps_mm + hit->distance_mm * needle.direction;
  return scene_.skin_index.closest_skin(needle.tip_lps_mm).point_lps_mm;
}

bool Patient::in_bone(const glm::dvec3& tip_lps_mm) const noexcept {
  if (scene_.classes.empty()) return false;
  const glm::dvec4 at = voxel_from_lps_ * glm::dvec4(tip_lps_mm, 1.0);
  std::size_t index = 0, stride = 1;
  for (int axis = 0; axis < 3; ++axis) {
    const double place = std::floor(at[axis] + 0.5);
    if (!(place >= 0.0 && place < scene_.volume.size_voxels[axis])) return false;
    index += static_cast<std::size_t>(place) * stride;
    stride *= static_cast<std::size_t>(scene_.volume.size_voxels[axis]);
  }
  return scene_.classes[index] == volume::TissueClass::bone;
}

void Patient::note(EventKind kind) noexcept {
  for (EventKind& place : waiting_) {
    if (place == kind) return;
    if (place != EventKind::none) continue;
    place = kind;
    return;
  }
}

EventKind Patient::advance(const cases::Inputs& inputs, const cases::State& state) noexcept {
  const cases::NeedleState& needle = state.needle;
  switch (inputs.event) {
    case EventKind::anaesthetic:
      if (!scene_.skin_index.empty()) numb_lps_mm_[numbed_++ % numb_lps_mm_.size()] = pointed_at(needle);
      break;
    case EventKind::breath_hold_request:
      if (!asked_ && !holds_) {
        asked_ = true;
        asked_s_ = state.t_s;
      }
      break;
    case EventKind::breathe_again:
      asked_ = holds_ = false;
      break;
    case EventKind::cough:
      if (holds_) note(EventKind::breath_lost);
      asked_ = holds_ = false;
      break;
    default:
      break;
  }
  if (asked_ && state.t_s - asked_s_ >= kGrantSeconds) {
    asked_ = false;
    holds_ = true;
    held_s_ = state.t_s;
    note(EventKind::breath_held);
  }
  if (holds_ && state.t_s - held_s_ >= kHoldSeconds) {
    holds_ = false;
    note(EventKind::breath_lost);
  }

  if (needle.skin.in_body && !was_in_body_) {
    bool numb = false;
    for (std::size_t i = 0; i < std::min<std::size_t>(numbed_, numb_lps_mm_.size()); ++i)
      numb = numb || glm::distance(numb_lps_mm_[i], needle.skin.entry_lps_mm) <= kNumbMm;
    if (!numb) note(EventKind::pain_skin);
  }
  was_in_body_ = needle.skin.in_body;
  if (needle.skin.in_body && in_bone(needle.tip_lps_mm)) {
    if (state.t_s - bone_s_ >= kBoneAgainSeconds) note(EventKind::pain_bone);
    bone_s_ = state.t_s;
  }

  const EventKind told = waiting_[0];
  std::rotate(waiting_.begin(), waiting_.begin() + 1, waiting_.end());
  waiting_.back() = EventKind::none;
  return told;
}

}  // namespace seldinger::engine
