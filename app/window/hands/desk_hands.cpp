#include "app/window/hands/desk_hands.h"

#include <algorithm>
#include <utility>

#include "sim/base/check.h"
#include "sim/haptics/arm_model.h"

namespace seldinger::app {
namespace {

using haptics::Side;
using haptics::Tool;

bool leads(const devices::HandIntent& intent) noexcept {
  const glm::dvec3 none(0.0);
  return intent.slide_lps_mm != none || intent.turn_lps_rad != none || intent.turn_own_rad != none ||
         intent.advance_mm != 0.0 || intent.guides > 0 || intent.resets > 0;
}

// Whether it has been so for said_s, as far as it was not otherwise since.
bool lasts(bool so, double said_s, double elapsed_s, double& lasted_s) noexcept {
  lasted_s = std::clamp(lasted_s + (so ? elapsed_s : -kForgivenTimes * elapsed_s), 0.0, 1.5 * said_s);
  return lasted_s >= said_s;
}

constexpr const char* kArmModel = "inverse3";

std::array<haptics::HandSettings, 2> two_arms() {
  const haptics::ArmModel* device = haptics::find_arm_model(kArmModel);
  CHECK(device != nullptr);
  haptics::HandSettings settings;
  settings.device = *device;
  return {settings, settings};
}

}  // namespace

bool limit_is_said(double held_back_n, double elapsed_s, double& left_s) noexcept {
  left_s = held_back_n > kFeltLessN ? kSaidLimitS : std::max(0.0, left_s - elapsed_s);
  return left_s > 0.0;
}

bool late_is_said(bool too_late, double elapsed_s, LateWatch& watch) noexcept {
  watch.returning_s = too_late ? haptics::kReturnS / 3.0 : std::max(0.0, watch.returning_s - elapsed_s);
  return lasts(watch.returning_s > 0.0, kSaidLateS, elapsed_s, watch.lasted_s);
}

DeskHands::DeskHands(const cases::Case& scene, const devices::HandsStart& start,
                     const devices::HandsSettings& settings, haptics::Handedness handedness, const Arms* arms)
    : scene_(scene), mouse_(scene.skin_index, start, settings), braced_(scene) {
  if (arms == nullptr) return;
  arms_.used = true;
  arms_.tools = {tool_of(handedness, Side::left), tool_of(handedness, Side::right)};
  if (!scene.classes.empty()) forces_.emplace(scene, two_arms());
  led_ = arms->led;
  mouse_.say(last_);
  const std::array<devices::ArmMapping, 2> stand = arm_mappings(arms->station, scene);
  for (std::size_t side = 0; led_ && side < 2; ++side) {
    const auto known = arms->station.find(kSideNames[side]);
    led_arm_[side] = LedArms::arm_of(known == arms->station.end() ? "" : known->second.ids.arm, side);
    const devices::ArmReading there = stand[side].reading_of(pose_in(last_, side));
    led_->put(led_arm_[side], {there.position_mm, there.orientation, false});
  }
  desk_ = std::make_unique<DeskArms>(arms->station, scene, handedness, arms->place);
}

std::optional<std::string> DeskHands::arm_model() const {
  if (!arms_.used) return std::nullopt;
  return (led_ ? "simulated " : "") + std::string(kArmModel);
}

void DeskHands::take_over(const cases::Inputs& left, const cases::State& state) noexcept {
  devices::HandsStart at{left.needle, left.probe};
  if (!desk_) {
    braced_.see(state);
    at = {braced_.put_back(left.needle, state.needle.inserted_mm), braced_.put_back(left.probe, 0.0)};
  }
  mouse_.take_over(at);
  last_ = left;
  for (std::size_t side = 0; desk_ && side < 2; ++side)
    desk_->leave_at(static_cast<Side>(side), pose_in(last_, side));
}

void DeskHands::lead(const cases::Inputs& wanted) noexcept {
  for (std::size_t side = 0; led_ && side < 2; ++side) {
    const cases::ToolPose& pose = arms_.tools[side] == Tool::needle ? wanted.needle : wanted.probe;
    led_->lead(led_arm_[side], desk_->stylus_for(static_cast<Side>(side), pose));
  }
}

engine::ToolsRead DeskHands::read() const noexcept {
  return {!mouse_leads(Tool::needle), !mouse_leads(Tool::probe)};
}

double DeskHands::press_mm(const cases::State& state) const noexcept {
  if (mouse_leads(Tool::probe)) return mouse_.press_mm();
  if (scene_.skin_index.empty()) return 0.0;
  const glm::dvec3 from = state.probe.origin_lps_mm - kLookMm * state.probe.axial;
  const auto hit = scene_.skin_index.first_hit(from, state.probe.axial, 2.0 * kLookMm);
  return hit ? kLookMm - hit->distance_mm : -kLookMm;
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
    if (!arm_led_[side] || !arms_.lost[side] || !moved || !leads(intent)) continue;
    mouse_.take_over({last_.needle, last_.probe});
    arm_led_[side] = false;
  }
  // An arm that the mouse leads pushes back by itself.
  devices::AxialForces resisting = forces;
  if (led_ && !mouse_leads(Tool::needle)) resisting.needle_n = 0.0;
  if (led_ && !mouse_leads(Tool::probe)) resisting.probe_n = 0.0;
  const bool was_away = std::exchange(
      away_, scene_.picture.modality == cases::Modality::xray && inputs.fluoroscope.hand_away && state.tick > 0);
  if (!desk_) braced_.see(state);
  if (away_) {
    devices::HandIntent buttons;
    buttons.freezes = intent.freezes;
    buttons.guides = intent.guides;
    mouse_.let_go();
    mouse_.advance(buttons, resisting, elapsed_s);
  } else {
    // Let go of, the needle did not go with a patient who breathes: it is taken up where it is.
    if (was_away && !desk_ && scene_.breathing)
      mouse_.take_over({braced_.put_back(last_.needle, mouse_.inserted_mm()), mouse_.probe()});
    mouse_.advance(intent, resisting, elapsed_s);
  }
  mouse_.say(inputs);
  lead(inputs);
  if (!desk_ && away_) {
    inputs.needle = last_.needle;
    inputs.probe = last_.probe;
  } else if (!desk_) {  // an arm's hand goes with the patient by itself
    inputs.needle = braced_.carried(inputs.needle, mouse_.inserted_mm());
    inputs.probe = braced_.carried(inputs.probe, 0.0);
  } else {
    read_arms(state, forces, elapsed_s, inputs);
  }
  last_ = inputs;
}

void DeskHands::read_arms(const cases::State& state, const devices::AxialForces& forces, double elapsed_s,
                          cases::Inputs& inputs) noexcept {
  cases::Inputs arms;
  desk_->read(state.needle.inserted_mm <= 0.0, forces.probe_n <= 0.0, elapsed_s, arms, held_);
  // A trigger that was pulled while the hand was away fires nothing, also not on the hand's return.
  pulled_away_ = arms.fire && (away_ || pulled_away_);
  inputs.fire = inputs.fire || (arms.fire && !pulled_away_);
  inputs.freeze = inputs.freeze != arms.freeze;  // either lets go what the other froze
  for (std::size_t side = 0; side < 2; ++side) {
    const bool heard = desk_->healthy(static_cast<Side>(side));
    arms_.lost[side] = lasts(!heard, kSaidLostS, elapsed_s, silent_s_[side]);
    const bool answers = heard && !arms_.lost[side];
    // A hand that is away goes where it likes and feels nothing; back, it grips its tool where that was left.
    held_[side].healthy = answers && !away_;
    arms_.late[side] =
        late_is_said(answers && held_[side].delay_ticks > haptics::kMostDelayTicks, elapsed_s, late_[side]);
    if (heard && !held_[side].healthy) desk_->let_go(static_cast<Side>(side));
    if (answers) arm_led_[side] = true;
    if (held_[side].healthy) {
      pose_in(inputs, side) = pose_in(arms, side);
    } else {
      if (arm_led_[side]) pose_in(inputs, side) = pose_in(last_, side);
      desk_->leave_at(static_cast<Side>(side), pose_in(inputs, side));
    }
  }
}

void DeskHands::feel(const engine::Tick& tick, const engine::TickState& now, double elapsed_s) noexcept {
  if (!desk_) return;
  if (!forces_) return desk_->send({}, elapsed_s);
  haptics::HandInputs felt = held_;
  for (haptics::HandInput& hand : felt) {
    tick.bring_to_rest(now, hand);
    hand.nicks_lps_mm = engine::nicks_of(now.patient);
    hand.introducer = now.introducer;
  }
  desk_->send(forces_->advance(felt, elapsed_s, felt_), elapsed_s);
  for (std::size_t side = 0; side < 2; ++side)
    arms_.at_limit[side] = limit_is_said(felt_[side].limiter.held_back_n, elapsed_s, limit_s_[side]);
}

void DeskHands::let_go() noexcept {
  if (desk_) desk_->let_go();
}

}  // namespace seldinger::app
