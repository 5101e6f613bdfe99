// Every field of TickState and of what is in it, in their order: each struct is taken apart by a structured
// binding, so that a field that is added, and not listed here, does not compile. Saving, restoring and hashing all
// go this way.
#pragma once

#include <concepts>
#include <type_traits>

#include "sim/engine/tick_state.h"

namespace seldinger::engine::fields {

template <typename S, typename T>
concept Is = std::same_as<std::remove_const_t<S>, T>;

// each(a, b, …) is called with the fields of `s`, const where `s` is.
template <typename Each, Is<cases::ToolPose> S>
void visit(Each&& each, S& s) {
  auto& [position, axis, side] = s;
  each(position, axis, side);
}
template <typename Each, Is<cases::SkinPassage> S>
void visit(Each&& each, S& s) {
  auto& [tip, depth, asked, triangle, inside, in_body, entry] = s;
  each(tip, depth, asked, triangle, inside, in_body, entry);
}
template <typename Each, Is<cases::NeedleState> S>
void visit(Each&& each, S& s) {
  auto& [tip, direction, skin, inserted] = s;
  each(tip, direction, skin, inserted);
}
template <typename Each, Is<cases::ConsoleSetting> S>
void visit(Each&& each, S& s) {
  auto& [depth, focus, frequency, slice] = s;
  each(depth, focus, frequency, slice);
}
template <typename Each, Is<cases::ProbeState> S>
void visit(Each&& each, S& s) {
  auto& [origin, axial, lateral, frozen, console] = s;
  each(origin, axial, lateral, frozen, console);
}
template <typename Each, Is<cases::BreathState> S>
void visit(Each&& each, S& s) {
  auto& [phase, breath, asked, failed, held, cough] = s;
  each(phase, breath, asked, failed, held, cough);
}
template <typename Each, Is<cases::PatientBreath> S>
void visit(Each&& each, S& s) {
  auto& [state, asked, moves, level] = s;
  each(state, asked, moves, level);
}
template <typename Each, Is<cases::FireState> S>
void visit(Each&& each, S& s) {
  auto& [fired, t, tip, direction] = s;
  each(fired, t, tip, direction);
}
template <typename Each, Is<cases::CArm> S>
void visit(Each&& each, S& s) {
  auto& [lao, cranial, sid, isocentre] = s;
  each(lao, cranial, sid, isocentre);
}
template <typename Each, Is<cases::Collimator> S>
void visit(Each&& each, S& s) {
  auto& [u, v] = s;
  each(u, v);
}
template <typename Each, Is<cases::Technique> S>
void visit(Each&& each, S& s) {
  auto& [kv, ma, pulse] = s;
  each(kv, ma, pulse);
}
template <typename Each, Is<cases::ViewingAngles> S>
void visit(Each&& each, S& s) {
  auto& [count, widest, lao, cranial] = s;
  each(count, widest, lao, cranial);
}
template <typename Each, Is<cases::FluoroscopyState> S>
void visit(Each&& each, S& s) {
  auto& [in_use, arm, arm_moving, beam_on, frame_due, live, hand_away, frames, wait, rate, magnification,
         collimator, technique, last_technique, frame_s, reported, time, while_moving, hand_in_beam, kerma, dap,
         collimated, views] = s;
  each(in_use, arm, arm_moving, beam_on, frame_due, live, hand_away, frames, wait, rate, magnification, collimator,
       technique, last_technique, frame_s, reported, time, while_moving, hand_in_beam, kerma, dap, collimated,
       views);
}
template <typename Each, Is<cases::State> S>
void visit(Each&& each, S& s) {
  auto& [tick, t, needle, probe, fire, breath, fluoroscopy] = s;
  each(tick, t, needle, probe, fire, breath, fluoroscopy);
}

template <typename Each, Is<haptics::NeedleTissue> S>
void visit(Each&& each, S& s) {
  auto& [slope, intercept, tip_stiffness, rupture, dent, impenetrable] = s;
  each(slope, intercept, tip_stiffness, rupture, dent, impenetrable);
}
template <typename Each, Is<haptics::NeedleLayer> S>
void visit(Each&& each, S& s) {
  auto& [start, tissue] = s;
  each(start, tissue);
}
template <typename Each, Is<haptics::NeedlePath> S>
void visit(Each&& each, S& s) {
  auto& [layers, tissues, count] = s;
  each(layers, tissues, count);
}
template <typename Each, Is<haptics::NeedleTrack> S>
void visit(Each&& each, S& s) {
  auto& [opened, cut, shaft, falling, damper, last_depth, last_elastic, begun] = s;
  each(opened, cut, shaft, falling, damper, last_depth, last_elastic, begun);
}
template <typename Each, Is<haptics::NeedleSideTrack> S>
void visit(Each&& each, S& s) {
  auto& [elastic, damper, last, stiffness, begun] = s;
  each(elastic, damper, last, stiffness, begun);
}
template <typename Each, Is<tissue::NeedleDrag> S>
void visit(Each&& each, S& s) {
  auto& [entry, direction, radius, cut, tip_n, tip_mm, shaft] = s;
  each(entry, direction, radius, cut, tip_n, tip_mm, shaft);
}
template <typename Each, Is<haptics::HeldNeedleState> S>
void visit(Each&& each, S& s) {
  auto& [skin, entry, direction, path, track, side, depth, looked, ticks_to_look, begun, free, outside, drag] = s;
  each(skin, entry, direction, path, track, side, depth, looked, ticks_to_look, begun, free, outside, drag);
}
template <typename Each, Is<haptics::ProbeTrack> S>
void visit(Each&& each, S& s) {
  auto& [last, shear, damper, last_elastic, side_stiffness, per_bone, touching] = s;
  each(last, shear, damper, last_elastic, side_stiffness, per_bone, touching);
}
template <typename Each, Is<tissue::SkinPress> S>
void visit(Each&& each, S& s) {
  auto& [at, inward, radius, depth, per_bone] = s;
  each(at, inward, radius, depth, per_bone);
}
template <typename Each, Is<haptics::HeldProbeState> S>
void visit(Each&& each, S& s) {
  auto& [track, asked, gap, bone, triangle, ticks_to_look, press] = s;
  each(track, asked, gap, bone, triangle, ticks_to_look, press);
}
template <typename Each, Is<haptics::ProxySpringTrack> S>
void visit(Each&& each, S& s) {
  auto& [elastic, damper] = s;
  each(elastic, damper);
}
template <typename Each, Is<haptics::SurfaceTrack> S>
void visit(Each&& each, S& s) {
  auto& [proxy, spring, triangle, begun, touching, holding] = s;
  each(proxy, spring, triangle, begun, touching, holding);
}
template <typename Each, Is<haptics::VolumeProxyTrack> S>
void visit(Each&& each, S& s) {
  auto& [proxy, spring, begun, touching, holding] = s;
  each(proxy, spring, begun, touching, holding);
}
template <typename Each, Is<haptics::ForceLimiterState> S>
void visit(Each&& each, S& s) {
  auto& [out, share, heat, fault_n, fault_s] = s;
  each(out, share, heat, fault_n, fault_s);
}
template <typename Each, Is<haptics::HandState> S>
void visit(Each&& each, S& s) {
  auto& [tool, needle, probe, finger, pointer, limiter, last, delay, interrupted] = s;
  each(tool, needle, probe, finger, pointer, limiter, last, delay, interrupted);
}

template <typename Each, Is<PatientState> S>
void visit(Each&& each, S& s) {
  auto& [numb, numbed, was_in_body, held, let_go, bone, waiting] = s;
  each(numb, numbed, was_in_body, held, let_go, bone, waiting);
}
template <typename Each, Is<devices::VirtualDeviceState> S>
void visit(Each&& each, S& s) {
  auto& [pose, started] = s;
  each(pose, started);
}
template <typename Each, Is<VirtualArms> S>
void visit(Each&& each, S& s) {
  auto& [needle, probe] = s;
  each(needle, probe);
}
template <typename Each, Is<shaders::DisplacementSource> S>
void visit(Each&& each, S& s) {
  auto& [place, along, size, amount] = s;
  each(place, along, size, amount);
}
template <typename Each, Is<tissue::Displacement> S>
void visit(Each&& each, S& s) {
  auto& [contact, tip, shaft, vein, breath, padding_0, padding_1, padding_2, source] = s;
  each(contact, tip, shaft, vein, breath, padding_0, padding_1, padding_2, source);
}
template <typename Each, Is<cases::ForceSample> S>
void visit(Each&& each, S& s) {
  auto& [t, axial, lateral, probe] = s;
  each(t, axial, lateral, probe);
}
template <typename Each, Is<LastEvent> S>
void visit(Each&& each, S& s) {
  auto& [kind, t] = s;
  each(kind, t);
}
template <typename Each, Is<TickState> S>
void visit(Each&& each, S& s) {
  auto& [state, hands, patient, arms, displacement, force, reaction, event, capsules, capsule_n, happened, hash] =
      s;
  each(state, hands, patient, arms, displacement, force, reaction, event, capsules, capsule_n, happened, hash);
}

}  // namespace seldinger::engine::fields
