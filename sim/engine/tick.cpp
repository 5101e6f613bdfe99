#include "sim/engine/tick.h"

#include <algorithm>
#include <glm/geometric.hpp>

#include "sim/engine/step.h"

namespace seldinger::engine {
namespace {

// Up the shaft from the tip, at least: there the needle's line is told by where the skin holds it.
constexpr double kShortestMm = 20.0;

// In TickState::hands.
constexpr std::size_t kProbeHand = 0, kNeedleHand = 1;

// A layer without a capsule is entered without anybody's noticing.
void note_capsule(const haptics::HeldNeedleState& needle, TickState& now) noexcept {
  if (needle.track.opened == 0) return;
  const double taken_n = needle.path.layers[needle.track.opened - 1].tissue.rupture_n;
  if (taken_n <= 0.0) return;
  ++now.capsules;
  now.capsule_n = taken_n;
}

std::optional<StandingTube> standing_tube(const TickState& now) noexcept {
  const haptics::HeldNeedleState& held = now.hands[kNeedleHand].needle;
  if (now.introducer != haptics::Introducer::open || !(held.track.sheath_mm > 0.0)) return std::nullopt;
  return StandingTube{held.entry_lps_mm, held.entry_lps_mm + held.track.sheath_mm * held.direction};
}

}  // namespace

Moment moment_of(const TickState& now) noexcept {
  return {now.state,
          now.displacement,
          now.force,
          now.reaction.kind,
          now.reaction.t_s,
          now.event.kind,
          now.event.t_s,
          now.capsules,
          now.capsule_n,
          now.patient.numbed,
          now.patient.numb_lps_mm,
          now.patient.deep,
          now.introducer,
          standing_tube(now),
          now.patient.nicked,
          now.patient.nick_lps_mm};
}

void Scenario::add_to(cases::Inputs& inputs, double t_s, std::uint32_t& happened) const noexcept {
  if (happened >= events_.size() || t_s < events_[happened].t_s || inputs.event != cases::EventKind::none) return;
  inputs.event = events_[happened].kind;
  ++happened;
}

Tick::Tick(const cases::Case& scene) : scene_(scene), tissue_(scene), patient_(scene), flows_(scene) {
  if (!scene.classes.empty()) hands_.emplace(scene, haptics::two_virtual_arms());
}

void Tick::bring_to_rest(const TickState& now, haptics::HandInput& hand) const noexcept {
  if (!tissue_.moves()) return;
  if (hand.tool == haptics::Tool::needle)
    hand.pose = at_rest(tissue_.felt_by_needle(now.state, now.hands), hand.pose,
                        std::max(kShortestMm, now.state.needle.inserted_mm));
  else if (hand.tool == haptics::Tool::probe)
    hand.pose.position_lps_mm = tissue::rest_of(tissue_.felt_by_probe(now.state), hand.pose.position_lps_mm);
}

std::optional<cases::ForceSample> Tick::feel(double elapsed_s, TickState& now) const noexcept {
  if (!hands_) return std::nullopt;
  const cases::State& state = now.state;
  haptics::HandInput needle, probe;
  needle.tool = haptics::Tool::needle;
  needle.pose.position_lps_mm = state.needle.tip_lps_mm;
  needle.pose.axis = state.needle.direction;
  needle.nicks_lps_mm = nicks_of(now.patient);
  needle.introducer = now.introducer;
  probe.tool = haptics::Tool::probe;
  probe.pose = {state.probe.origin_lps_mm, state.probe.axial, state.probe.lateral};
  bring_to_rest(now, needle);
  bring_to_rest(now, probe);
  const haptics::HandForces forces = hands_->advance({probe, needle}, elapsed_s, now.hands);
  const haptics::HeldNeedleState& held = now.hands[kNeedleHand].needle;
  if (forces[kNeedleHand].ruptured) note_capsule(held, now);
  // In beside the hole in which the introducer stood: that one is left.
  if (now.introducer == haptics::Introducer::open && held.skin.in_body && held.track.opened > 0 &&
      held.track.sheath_mm == 0.0)
    now.introducer = haptics::Introducer::none;
  const glm::dvec3& needle_n = forces[kNeedleHand].wanted_n;
  const double axial_n = -glm::dot(needle_n, needle.pose.axis);
  return cases::ForceSample{state.t_s, axial_n, glm::length(needle_n + axial_n * needle.pose.axis),
                            glm::length(forces[kProbeHand].wanted_n)};
}

std::optional<glm::dvec3> Tick::rest_of(const glm::dvec3& tip_lps_mm, const TickState& now) const noexcept {
  if (!tissue_.moves()) return std::nullopt;
  return tissue::rest_of(now.displacement, tip_lps_mm);
}

cases::RecordedTick Tick::advance(const cases::Inputs& inputs, double dt_s, TickState& now) const noexcept {
  cases::RecordedTick tick;
  tick.inputs = inputs;
  cases::State& state = now.state;
  const bool fired = state.fire.fired;
  // By what held until now: a hand's tick is felt, and shows, in the next.
  step(scene_, inputs, dt_s, tissue_.felt_by_needle(state, now.hands), state);
  flows_.advance(inputs, state.needle, dt_s, state.flow);
  now.hash = cases::state_hash(state, now.hash);
  tick.hash = static_cast<std::uint32_t>(now.hash);
  tick.reaction = patient_.advance(inputs, state, now.patient);
  if (tick.reaction != cases::EventKind::none) now.reaction = {tick.reaction, state.t_s};
  if (inputs.event != cases::EventKind::none) now.event = {inputs.event, state.t_s};
  if (scene_.instrument.kind == cases::InstrumentKind::core)
    now.introducer = cases::introducer_after(inputs.event, state.needle.skin.in_body, now.introducer);
  now.force = feel(dt_s, now);
  // Before a core needle's throw, in the same tick, drags what the trigger found.
  if (state.fire.fired && !fired)
    tick.endpoint = cases::Endpoint{state.fire.t_s, state.fire.tip_lps_mm, state.fire.direction,
                                    rest_of(state.fire.tip_lps_mm, now)};
  if (tissue_.moves()) now.displacement = tissue_.seen(state, now.hands);
  if ((state.tick - 1) % cases::kPoseTicks == 0) {
    tick.pose = cases::pose_of(state);
    tick.pose->rest_tip_lps_mm = rest_of(state.needle.tip_lps_mm, now);
    tick.force = now.force;
  }
  return tick;
}

cases::RecordedTick Tick::advance_hands(const cases::Inputs& hands, ToolsRead read, TickState& now) const noexcept {
  const auto through = [](bool is_read, const cases::ToolPose& pose, devices::VirtualDeviceState& arm) {
    return is_read ? devices::follow(pose, arm) : devices::advance(pose, base::kTickS, arm);
  };
  cases::Inputs inputs = hands;
  inputs.needle = through(read.needle, hands.needle, now.arms.needle);
  inputs.probe = through(read.probe, hands.probe, now.arms.probe);
  return advance(inputs, base::kTickS, now);
}

}  // namespace seldinger::engine
