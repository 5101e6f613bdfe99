#include "app/attempt_ticks.h"

#include <glm/geometric.hpp>

#include "app/servo_trial.h"
#include "sim/engine/step.h"

namespace seldinger::app {

cases::PoseSample pose_of(const cases::State& state) {
  return {state.t_s,         state.needle.tip_lps_mm, state.needle.direction, state.probe.origin_lps_mm,
          state.probe.axial, state.probe.lateral};
}

ModelForces::ModelForces(const cases::Case& scene) {
  if (!scene.classes.empty()) hands_.emplace(scene, two_virtual_devices());
}

std::optional<cases::ForceSample> ModelForces::advance(const cases::State& state, double elapsed_s) noexcept {
  if (!hands_) return std::nullopt;
  haptics::HandInput needle, probe;
  needle.tool = haptics::Tool::needle;
  needle.pose.position_lps_mm = state.needle.tip_lps_mm;
  needle.pose.axis = state.needle.direction;
  probe.tool = haptics::Tool::probe;
  probe.pose = {state.probe.origin_lps_mm, state.probe.axial, state.probe.lateral};
  const haptics::HandForces forces = hands_->advance({probe, needle}, elapsed_s, states_);
  const glm::dvec3& needle_n = forces[1].wanted_n;
  const double axial_n = -glm::dot(needle_n, state.needle.direction);
  return cases::ForceSample{state.t_s, axial_n, glm::length(needle_n + axial_n * state.needle.direction),
                            glm::length(forces[0].wanted_n)};
}

assessment::RecordedTick AttemptTicks::advance(const cases::Inputs& hands) noexcept {
  constexpr double kTickS = engine::kTickSeconds;
  assessment::RecordedTick tick;
  tick.inputs = hands;
  tick.inputs.needle = needle_arm_.advance(hands.needle, kTickS);
  tick.inputs.probe = probe_arm_.advance(hands.probe, kTickS);
  const bool fired = state_.fire.fired;
  engine::step(scene_, tick.inputs, kTickS, state_);
  hash_ = cases::state_hash(state_, hash_);
  tick.hash = static_cast<std::uint32_t>(hash_);
  tick.reaction = patient_.advance(tick.inputs, state_);
  const auto force = forces_.advance(state_, kTickS);
  if ((state_.tick - 1) % kPoseTicks == 0) {
    tick.pose = pose_of(state_);
    tick.force = force;
  }
  if (state_.fire.fired && !fired)
    tick.endpoint = cases::Endpoint{state_.fire.t_s, state_.fire.tip_lps_mm, state_.fire.direction};
  return tick;
}

}  // namespace seldinger::app
