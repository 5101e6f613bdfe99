#include "sim/engine/patient.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "sim/tissue/breathing.h"

namespace seldinger::engine {
namespace {

using cases::EventKind;

constexpr double kPointingMm = 150.0;  // a needle held nearer than this points at a place on the skin

void note(EventKind kind, PatientState& patient) noexcept {
  if (kind == EventKind::none) return;
  for (EventKind& place : patient.waiting) {
    if (place == kind) return;
    if (place != EventKind::none) continue;
    place = kind;
    return;
  }
}

EventKind return_of(cases::LumenContent content) noexcept {
  constexpr EventKind kReturns[] = {EventKind::none,
                                    EventKind::urine_returns,
                                    EventKind::bile_returns,
                                    EventKind::dark_blood_returns,
                                    EventKind::bright_blood_returns,
                                    EventKind::fluid_returns};
  return kReturns[static_cast<std::size_t>(content)];
}

bool is_numb(const glm::dvec3& place_lps_mm, const std::array<glm::dvec3, kNumbPlaces>& places_lps_mm,
             std::uint32_t given) noexcept {
  return std::any_of(places_lps_mm.begin(), places_lps_mm.begin() + std::min<std::size_t>(given, kNumbPlaces),
                     [&](const glm::dvec3& numb) { return glm::distance(numb, place_lps_mm) <= kNumbMm; });
}

}  // namespace

std::span<const glm::dvec3> nicks_of(const PatientState& patient) noexcept {
  return {patient.nick_lps_mm.data(), std::min<std::size_t>(patient.nicked, kNickPlaces)};
}

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

void Patient::numb(const cases::Inputs& inputs, const cases::NeedleState& needle,
                   PatientState& patient) const noexcept {
  if (needle.skin.in_body && inputs.event_tenths_mm > 0)
    patient.deep_lps_mm[patient.deep++ % kNumbPlaces] = needle.skin.tip_lps_mm;
  else
    patient.numb_lps_mm[patient.numbed++ % kNumbPlaces] = pointed_at(needle);
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

EventKind Patient::advance(const cases::Inputs& inputs, const cases::State& state,
                           PatientState& patient) const noexcept {
  if (scene_.subject == cases::Subject::phantom) return EventKind::none;
  const cases::NeedleState& needle = state.needle;
  if (inputs.event == EventKind::anaesthetic && !scene_.skin_index.empty()) numb(inputs, needle, patient);
  // By the law of touch of before, nobody felt one.
  if (inputs.event == EventKind::nick && !scene_.skin_index.empty() && scene_.touch.law != cases::TouchLaw::steady)
    patient.nick_lps_mm[patient.nicked++ % kNickPlaces] = pointed_at(needle);
  if (inputs.event == EventKind::breathe_again) patient.let_go = true;
  const bool held = tissue::holds(state.breath.state);
  if (held && !patient.held) {
    note(EventKind::breath_held, patient);
    patient.let_go = false;
  }
  if (!held && patient.held && !patient.let_go) note(EventKind::breath_lost, patient);
  patient.held = held;

  const auto deeply_numb = [&](const glm::dvec3& place_lps_mm) {
    return is_numb(place_lps_mm, patient.deep_lps_mm, patient.deep);
  };
  const glm::dvec3& entry_lps_mm = needle.skin.entry_lps_mm;
  if (needle.skin.in_body && !patient.was_in_body && !is_numb(entry_lps_mm, patient.numb_lps_mm, patient.numbed) &&
      !deeply_numb(entry_lps_mm))
    note(EventKind::pain_skin, patient);
  patient.was_in_body = needle.skin.in_body;
  if (needle.skin.in_body && in_bone(needle.skin.tip_lps_mm)) {
    if (state.t_s - patient.bone_s >= kBoneAgainSeconds && !deeply_numb(needle.skin.tip_lps_mm))
      note(EventKind::pain_bone, patient);
    patient.bone_s = state.t_s;
  }

  if (state.flow.at_hub != patient.returned) note(return_of(state.flow.at_hub), patient);
  patient.returned = state.flow.at_hub;

  const EventKind told = patient.waiting[0];
  std::rotate(patient.waiting.begin(), patient.waiting.begin() + 1, patient.waiting.end());
  patient.waiting.back() = EventKind::none;
  return told;
}

}  // namespace seldinger::engine
