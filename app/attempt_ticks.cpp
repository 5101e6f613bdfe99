#include "app/attempt_ticks.h"

#include <algorithm>
#include <glm/geometric.hpp>

#include "app/servo_trial.h"
#include "sim/engine/step.h"

namespace seldinger::app {

cases::PoseSample pose_of(const cases::State& state) {
  return {state.t_s,         state.needle.tip_lps_mm, state.needle.direction, state.probe.origin_lps_mm,
          state.probe.axial, state.probe.lateral};
}

namespace {

// Up the shaft from the tip, at least: there the needle's line is told by where the skin holds it.
constexpr double kShortestMm = 20.0;

}  // namespace

Room::Room(const cases::Case& scene) : scene_(scene), tissue_(scene), patient_(scene) {
  if (!scene.classes.empty()) hands_.emplace(scene, two_virtual_devices());
}

void Room::bring_to_rest(haptics::HandInput& hand) const noexcept {
  if (!tissue_.moves()) return;
  if (hand.tool == haptics::Tool::needle)
    hand.pose = engine::at_rest(tissue_.felt_by_needle(state_, hand_states_), hand.pose,
                                std::max(kShortestMm, state_.needle.inserted_mm));
  else if (hand.tool == haptics::Tool::probe)
    hand.pose.position_lps_mm = tissue::rest_of(tissue_.felt_by_probe(state_), hand.pose.position_lps_mm);
}

// A layer without a capsule is entered without anybody's noticing.
void Room::note_capsule(const haptics::HeldNeedleState& needle) noexcept {
  if (needle.track.opened == 0) return;
  const double taken_n = needle.path.layers[needle.track.opened - 1].tissue.rupture_n;
  if (taken_n <= 0.0) return;
  ++capsules_;
  capsule_n_ = taken_n;
}

std::optional<cases::ForceSample> Room::feel(double elapsed_s) noexcept {
  if (!hands_) return std::nullopt;
  haptics::HandInput needle, probe;
  needle.tool = haptics::Tool::needle;
  needle.pose.position_lps_mm = state_.needle.tip_lps_mm;
  needle.pose.axis = state_.needle.direction;
  probe.tool = haptics::Tool::probe;
  probe.pose = {state_.probe.origin_lps_mm, state_.probe.axial, state_.probe.lateral};
  bring_to_rest(needle);
  bring_to_rest(probe);
  const haptics::HandForces forces = hands_->advance({probe, needle}, elapsed_s, hand_states_);
  if (forces[1].ruptured) note_capsule(hand_states_[1].needle);
  const glm::dvec3& needle_n = forces[1].wanted_n;
  const double axial_n = -glm::dot(needle_n, needle.pose.axis);
  return cases::ForceSample{state_.t_s, axial_n, glm::length(needle_n + axial_n * needle.pose.axis),
                            glm::length(forces[0].wanted_n)};
}

std::optional<glm::dvec3> Room::rest_of(const glm::dvec3& tip_lps_mm) const noexcept {
  if (!tissue_.moves()) return std::nullopt;
  return tissue::rest_of(displacement_, tip_lps_mm);
}

assessment::RecordedTick Room::advance(const cases::Inputs& inputs, double dt_s) noexcept {
  assessment::RecordedTick tick;
  tick.inputs = inputs;
  const bool fired = state_.fire.fired;
  // By what held until now: a hand's tick is felt, and shows, in the next.
  engine::step(scene_, inputs, dt_s, tissue_.felt_by_needle(state_, hand_states_), state_);
  hash_ = cases::state_hash(state_, hash_);
  tick.hash = static_cast<std::uint32_t>(hash_);
  tick.reaction = patient_.advance(inputs, state_);
  if (tick.reaction != cases::EventKind::none) {
    reaction_ = tick.reaction;
    reaction_t_s_ = state_.t_s;
  }
  if (inputs.event != cases::EventKind::none) {
    event_ = inputs.event;
    event_t_s_ = state_.t_s;
  }
  force_ = feel(dt_s);
  // Before a core needle's throw, in the same tick, drags what the trigger found.
  if (state_.fire.fired && !fired)
    tick.endpoint = cases::Endpoint{state_.fire.t_s, state_.fire.tip_lps_mm, state_.fire.direction,
                                    rest_of(state_.fire.tip_lps_mm)};
  if (tissue_.moves()) displacement_ = tissue_.seen(state_, hand_states_);
  if ((state_.tick - 1) % kPoseTicks == 0) {
    tick.pose = pose_of(state_);
    tick.pose->rest_tip_lps_mm = rest_of(state_.needle.tip_lps_mm);
    tick.force = force_;
  }
  return tick;
}

assessment::RecordedTick AttemptTicks::advance(const cases::Inputs& hands, ToolsRead read) noexcept {
  constexpr double kTickS = engine::kTickSeconds;
  cases::Inputs inputs = hands;
  inputs.needle = read.needle ? needle_arm_.follow(hands.needle) : needle_arm_.advance(hands.needle, kTickS);
  inputs.probe = read.probe ? probe_arm_.follow(hands.probe) : probe_arm_.advance(hands.probe, kTickS);
  return room_.advance(inputs, kTickS);
}

}  // namespace seldinger::app
