#include "app/train/desk_hands.h"

#include "sim/base/check.h"
#include "sim/haptics/haptic_device.h"

namespace seldinger::app {
namespace {

using haptics::Side;
using haptics::Tool;

bool leads(const devices::HandIntent& intent) noexcept {
  const glm::dvec3 none(0.0);
  return intent.slide_lps_mm != none || intent.turn_lps_rad != none || intent.turn_own_rad != none ||
         intent.advance_mm != 0.0 || intent.guides > 0 || intent.resets > 0;
}

std::array<haptics::HandSettings, 2> two_arms() {
  const haptics::HapticDevice* device = haptics::find_haptic_device("inverse3");
  CHECK(device != nullptr);
  haptics::HandSettings settings;
  settings.device = *device;
  return {settings, settings};
}

}  // namespace

DeskHands::DeskHands(const cases::Case& scene, const devices::HandsStart& start,
                     const devices::HandsSettings& settings, haptics::Handedness handedness, const Arms* arms)
    : mouse_(scene.skin_index, start, settings), braced_(scene) {
  if (arms == nullptr) return;
  arms_.used = true;
  arms_.tools = {tool_of(handedness, Side::left), tool_of(handedness, Side::right)};
  if (!scene.classes.empty()) forces_.emplace(scene, two_arms());
  desk_ = std::make_unique<DeviceDesk>(arms->station, scene, handedness, arms->place);
}

cases::ToolPose& DeskHands::pose_in(cases::Inputs& inputs, std::size_t side) const noexcept {
  return arms_.tools[side] == Tool::needle ? inputs.needle : inputs.probe;
}

bool DeskHands::mouse_leads(Tool tool) const noexcept {
  for (std::size_t side = 0; side < 2; ++side)
    if (arms_.tools[side] == tool && arm_led_[side]) return false;
  return true;
}

void DeskHands::advance(const devices::HandIntent& intent, const cases::State& state,
                        const devices::AxialForces& forces, double elapsed_s, cases::Inputs& inputs) noexcept {
  const Tool mouses = mouse_.held() == devices::HeldTool::needle ? Tool::needle : Tool::probe;
  for (std::size_t side = 0; desk_ && side < 2; ++side) {
    const bool moved = arms_.tools[side] == mouses || intent.resets > 0;
    if (!arm_led_[side] || desk_->healthy(static_cast<Side>(side)) || !moved || !leads(intent)) continue;
    mouse_.take_over({last_.needle, last_.probe});
    arm_led_[side] = false;
  }
  mouse_.advance(intent, forces, elapsed_s);
  mouse_.say(inputs);
  if (!desk_) {  // an arm's hand goes with the patient by itself
    braced_.see(state);
    inputs.needle = braced_.carried(inputs.needle, mouse_.inserted_mm());
    inputs.probe = braced_.carried(inputs.probe, 0.0);
  } else {
    cases::Inputs arms;
    desk_->read(state.needle.inserted_mm <= 0.0, forces.probe_n <= 0.0, elapsed_s, arms, held_);
    inputs.fire = inputs.fire || arms.fire;
    inputs.freeze = inputs.freeze != arms.freeze;  // either lets go what the other froze
    for (std::size_t side = 0; side < 2; ++side) {
      const bool answers = desk_->healthy(static_cast<Side>(side));
      silent_s_[side] = answers ? 0.0 : silent_s_[side] + elapsed_s;
      arms_.lost[side] = silent_s_[side] >= kSaidLostS;
      if (answers) {
        arm_led_[side] = true;
        pose_in(inputs, side) = pose_in(arms, side);
      } else {
        if (arm_led_[side]) pose_in(inputs, side) = pose_in(last_, side);
        desk_->leave_at(static_cast<Side>(side), pose_in(inputs, side));
      }
    }
  }
  last_ = inputs;
}

void DeskHands::feel(const Room& room, double elapsed_s) noexcept {
  if (!desk_) return;
  if (!forces_) return desk_->send({});
  haptics::HandInputs felt = held_;
  for (haptics::HandInput& hand : felt) room.bring_to_rest(hand);
  desk_->send(forces_->advance(felt, elapsed_s, felt_));
}

void DeskHands::let_go() noexcept {
  if (desk_) desk_->let_go();
}

}  // namespace seldinger::app
