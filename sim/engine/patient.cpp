#include "sim/engine/patient.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "sim/tissue/breathing.h"

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
  const auto hit = scene_.skin_index.first_hit(needle.skin.tip_lps_mm, needle.direction, kPointingMm);
  if (hit && !hit->cut) return needle.skin.tip_lps_mm + hit->distance_mm * needle.direction;
  return scene_.skin_index.closest_skin(needle.skin.tip_lps_mm).point_lps_mm;
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
  if (scene_.subject == cases::Subject::phantom) return EventKind::none;
  const cases::NeedleState& needle = state.needle;
  if (inputs.event == EventKind::anaesthetic && !scene_.skin_index.empty())
    numb_lps_mm_[numbed_++ % numb_lps_mm_.size()] = pointed_at(needle);
  if (inputs.event == EventKind::breathe_again) let_go_ = true;
  const bool held = tissue::holds(state.breath.state);
  if (held && !held_) {
    note(EventKind::breath_held);
    let_go_ = false;
  }
  if (!held && held_ && !let_go_) note(EventKind::breath_lost);
  held_ = held;

  if (needle.skin.in_body && !was_in_body_) {
    bool numb = false;
    for (std::size_t i = 0; i < std::min<std::size_t>(numbed_, numb_lps_mm_.size()); ++i)
      numb = numb || glm::distance(numb_lps_mm_[i], needle.skin.entry_lps_mm) <= kNumbMm;
    if (!numb) note(EventKind::pain_skin);
  }
  was_in_body_ = needle.skin.in_body;
  if (needle.skin.in_body && in_bone(needle.skin.tip_lps_mm)) {
    if (state.t_s - bone_s_ >= kBoneAgainSeconds) note(EventKind::pain_bone);
    bone_s_ = state.t_s;
  }

  const EventKind told = waiting_[0];
  std::rotate(waiting_.begin(), waiting_.begin() + 1, waiting_.end());
  waiting_.back() = EventKind::none;
  return told;
}

}  // namespace seldinger::engine
