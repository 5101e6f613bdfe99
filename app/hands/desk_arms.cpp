#include "app/hands/desk_arms.h"

#include <glm/vec4.hpp>

#include "sim/haptics/arm_model.h"

namespace seldinger::app {
namespace {

glm::dvec3 middle_of(const volume::Volume& volume) {
  const glm::dvec3 half = 0.5 * (glm::dvec3(volume.size_voxels) - 1.0);
  return glm::dvec3(volume.lps_from_voxel * glm::dvec4(half, 1.0));
}

glm::dvec3 entry_of(const cases::Case& scene) {
  if (scene.planned_entry_lps_mm) return *scene.planned_entry_lps_mm;
  if (scene.lesions.empty()) return middle_of(scene.volume);
  const glm::dvec3 target = scene.lesions.front().center_lps_mm, up = cases::upwards(scene.position);
  constexpr double kFurthestMm = 1000.0;
  const auto hit = scene.skin_index.empty() ? std::nullopt : scene.skin_index.first_hit(target, up, kFurthestMm);
  return hit ? target + up * hit->distance_mm : target;
}

}  // namespace

std::array<devices::ArmMapping, 2> arm_mappings(const Station& station, const cases::Case& scene) {
  const glm::dvec3 entry = entry_of(scene);
  const devices::StandsAt stands = devices::side_of(entry, middle_of(scene.volume), scene.position);
  const auto hand = [&](const char* side) {
    const auto known = station.find(side);
    const StationDevice device = known == station.end() ? StationDevice{} : known->second;
    return devices::ArmMapping(
        device.calibration.template_from_device,
        devices::patient_from_template(scene.position, stands, entry, device.gains.motion_scale), device.gains);
  };
  return {hand(kSideNames[0]), hand(kSideNames[1])};
}

devices::HaplySettings haply_settings(const Station& station, const devices::WebSocketPlace& place) {
  devices::HaplySettings settings;
  settings.place = place;
  for (std::size_t side = 0; side < 2; ++side)
    if (const auto known = station.find(kSideNames[side]); known != station.end())
      settings.ids[side] = known->second.ids;
  return settings;
}

DeskArms::DeskArms(const Station& station, const cases::Case& scene, haptics::Handedness handedness,
                   const devices::WebSocketPlace& place)
    : handedness_(handedness), hands_(arm_mappings(station, scene)), haply_(haply_settings(station, place)) {}

void DeskArms::read(bool needle_outside, bool probe_off, double elapsed_s, cases::Inputs& inputs,
                    haptics::HandInputs& hands) noexcept {
  for (std::size_t side = 0; side < 2; ++side) {
    const haptics::Tool tool = haptics::tool_of(handedness_, static_cast<haptics::Side>(side));
    const bool is_needle = tool == haptics::Tool::needle;
    const devices::ArmReading& reading = readings_[side] = haply_.hand(side).poll();
    const cases::ToolPose& pose = hands_[side].advance(reading, is_needle ? needle_outside : probe_off, elapsed_s);
    (is_needle ? inputs.needle : inputs.probe) = pose;
    // A moment of silence lets no button go, or one that is held down would be pressed anew after it.
    const bool was_pressed = pressed_[side];
    if (reading.healthy) pressed_[side] = reading.buttons[0];
    if (is_needle) {
      inputs.fire = pressed_[side];
    } else {
      if (pressed_[side] && !was_pressed) frozen_ = !frozen_;
      inputs.freeze = frozen_;
    }
    hands[side] = {pose, tool, hands_[side].healthy(), devices::delay_ticks(reading, haptics::kTickS)};
  }
}

void DeskArms::send(const haptics::HandForces& forces, double elapsed_s) noexcept {
  for (std::size_t side = 0; side < 2; ++side) {
    const glm::dvec3 force_n = hands_[side].device_force(forces[side].motor_n);
    haply_.hand(side).send(force_n);
    watch_.see(side, readings_[side], force_n, elapsed_s);
  }
}

LedStylus DeskArms::stylus_for(haptics::Side side, const cases::ToolPose& pose) const noexcept {
  const devices::ArmReading reading = hands_[static_cast<std::size_t>(side)].reading_of(pose);
  return {reading.position_mm, reading.orientation, false};
}

}  // namespace seldinger::app
