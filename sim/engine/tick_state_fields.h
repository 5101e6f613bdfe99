// Every field of TickState and of what is in it, in their order. Saving, restoring and hashing all go this way.
#pragma once

#include <concepts>
#include <type_traits>

#include "sim/engine/tick_state.h"

namespace seldinger::engine::fields {

template <typename S, typename T>
concept Is = std::same_as<std::remove_const_t<S>, T>;

// visit(each, s) calls each(a, b, …) with all fields of `s`, const where `s` is. One list takes the struct apart
// and hands its fields on, so that a field that is added to the struct, and not listed here, does not compile.
#define SELDINGER_FIELDS(TYPE, ...)    \
  template <typename Each, Is<TYPE> S> \
  void visit(Each&& each, S& s) {      \
    auto& [__VA_ARGS__] = s;           \
    each(__VA_ARGS__);                 \
  }

SELDINGER_FIELDS(cases::ToolPose, position, axis, side)
SELDINGER_FIELDS(cases::SkinPassage, tip, depth, asked, triangle, inside, in_body, entry)
SELDINGER_FIELDS(cases::NeedleState, tip, direction, skin, inserted)
SELDINGER_FIELDS(cases::ConsoleSetting, depth, focus, frequency, slice, colour, compound, lean, across, down)
SELDINGER_FIELDS(cases::ProbeState, origin, axial, lateral, frozen, console)
SELDINGER_FIELDS(cases::BreathState, phase, breath, asked, failed, held, cough, holds, hold_off)
SELDINGER_FIELDS(cases::PatientBreath, state, asked, moves, level)
SELDINGER_FIELDS(cases::FireState, fired, t, tip, direction)
SELDINGER_FIELDS(cases::CArm, lao, cranial, sid, isocentre)
SELDINGER_FIELDS(cases::Collimator, u, v)
SELDINGER_FIELDS(cases::Technique, kv, ma, pulse)
SELDINGER_FIELDS(cases::ViewingAngles, count, widest, lao, cranial)
SELDINGER_FIELDS(cases::FluoroscopyState, in_use, arm, arm_moving, beam_on, frame_due, live, hand_away, frames,
                 wait, rate, magnification, collimator, technique, last_technique, frame_s, reported, time,
                 while_moving, hand_in_beam, kerma, dap, collimated, views)
SELDINGER_FIELDS(cases::ContrastPool, lumen, at_rest, spread, contrast)
SELDINGER_FIELDS(cases::NeedleFlow, in_use, stylet_out, column, column_ml, at_hub, aspirated, syringe, injected,
                 carried_away, pools)
SELDINGER_FIELDS(cases::State, tick, t, needle, probe, fire, breath, fluoroscopy, flow)

SELDINGER_FIELDS(haptics::NeedleTissue, slope, intercept, tip_stiffness, rupture, dent, impenetrable)
SELDINGER_FIELDS(haptics::NeedleLayer, start, tissue)
SELDINGER_FIELDS(haptics::NeedlePath, layers, tissues, count)
SELDINGER_FIELDS(haptics::NeedleTrack, opened, cut, shaft, falling, damper, last_depth, last_elastic, speed, sheath,
                 begun, exchanged)
SELDINGER_FIELDS(haptics::NeedleSideTrack, elastic, damper, last, stiffness, begun)
SELDINGER_FIELDS(tissue::NeedleDrag, entry, direction, radius, cut, tip_n, tip_mm, shaft, organ, organ_n)
SELDINGER_FIELDS(haptics::HeldNeedleState, skin, entry, direction, path, track, side, depth, looked, ticks_to_look,
                 introducer, begun, free, outside, drag)
SELDINGER_FIELDS(haptics::ProbeTrack, last, shear, damper, last_elastic, side_stiffness, per_bone, touching)
SELDINGER_FIELDS(tissue::SkinPress, at, inward, radius, depth, per_bone)
SELDINGER_FIELDS(haptics::HeldProbeState, track, asked, gap, bone, triangle, ticks_to_look, press)
SELDINGER_FIELDS(haptics::ProxySpringTrack, elastic, damper)
SELDINGER_FIELDS(haptics::SurfaceTrack, proxy, spring, triangle, begun, touching, holding)
SELDINGER_FIELDS(haptics::VolumeProxyTrack, proxy, spring, begun, touching, holding)
SELDINGER_FIELDS(haptics::ForceLimiterState, out, share, heat, fault_n, fault_s, held_back)
SELDINGER_FIELDS(haptics::HandState, tool, needle, probe, finger, pointer, limiter, last, delay, interrupted)

SELDINGER_FIELDS(PatientState, numb, numbed, deep_at, deep, nick, nicked, was_in_body, held, let_go, returned, bone,
                 waiting)
SELDINGER_FIELDS(devices::VirtualDeviceState, pose, started)
SELDINGER_FIELDS(VirtualArms, needle, probe)
SELDINGER_FIELDS(shaders::DisplacementSource, place, along, size, amount)
SELDINGER_FIELDS(tissue::Displacement, contact, tip, shaft, vein, breath, organ, padding_0, padding_1, source, wall)
SELDINGER_FIELDS(cases::ForceSample, t, axial, lateral, probe)
SELDINGER_FIELDS(LastEvent, kind, t)
SELDINGER_FIELDS(TickState, state, hands, patient, arms, introducer, displacement, force, reaction, event, capsules,
                 capsule_n, happened, hash)

}  // namespace seldinger::engine::fields
