// A recording, made again from its inputs.
#pragma once

#include <cstdint>
#include <functional>

#include "sim/case/case.h"
#include "sim/case/record/recording.h"
#include "sim/case/state.h"
#include "sim/tissue/displacement.h"

namespace seldinger::session {

// Replays the inputs by this step version: states, poses and, where the scene has tissue and the recording them,
// forces. `seen` is called after each tick, up to the first that differs. What another step version recorded is
// walked through and compared with nothing: not the same.
using TickSeen = std::function<void(const cases::State&, const tissue::Displacement&)>;
struct Replay {
  bool same = false;
  std::uint64_t first_difference_tick = 0;
};
Replay replay(const cases::Case& scene, const cases::Recording& recording, const TickSeen& seen = {});

}  // namespace seldinger::session
