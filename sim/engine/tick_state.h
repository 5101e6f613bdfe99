// All that must be saved of an attempt to go on with it: what the next tick reads, and what is told of the ticks
// so far. Plain data with one writer, engine/tick.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "sim/base/result.h"
#include "sim/case/record/recording.h"
#include "sim/case/state.h"
#include "sim/devices/virtual_arm.h"
#include "sim/engine/patient.h"
#include "sim/haptics/two_hands.h"
#include "sim/tissue/displacement.h"

namespace seldinger::engine {

// The arms that stand between hands and tools where no real ones do.
struct VirtualArms {
  devices::VirtualDeviceState needle, probe;
};

// The last of its kind, and when it was.
struct LastEvent {
  cases::EventKind kind = cases::EventKind::none;
  double t_s = 0.0;
};

struct TickState {
  cases::State state;
  haptics::HandStates hands{};  // by haptics::Side: probe, needle
  PatientState patient;
  VirtualArms arms;
  haptics::Introducer introducer{};           // of a core needle
  tissue::Displacement displacement{};        // where what pictures show is
  std::optional<cases::ForceSample> force{};  // none: nothing is felt in this case
  LastEvent reaction;                         // the patient's
  LastEvent event;                            // what was said, or a mentor let happen
  std::uint32_t capsules = 0;                 // that the needle opened since the beginning,
  double capsule_n = 0.0;                     // and the force that the last one took
  std::uint32_t happened = 0;                 // how many of a scenario's events have happened
  std::uint64_t hash = 0;                     // cases::state_hash, chained
};

// Of every field, by its bits; the same on every machine. (What recordings keep of each tick is TickState::hash,
// of `state` alone.)
std::uint64_t tick_state_hash(const TickState& now) noexcept;

// As bytes, and back, every bit as it was. Refused: `damaged` (cut short, foreign, altered), `state_version` (of
// another format or step version).
std::vector<std::byte> saved(const TickState& now);
base::Result<TickState> restored(std::span<const std::byte> bytes);

}  // namespace seldinger::engine
