// A guidance's state as bytes: saved beside engine::TickState (sim/engine/tick_state.h), an attempt goes on from
// both.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "session/guidance/guidance.h"
#include "sim/base/result.h"

namespace seldinger::session {

// Every bit comes back as it was. Refused: `damaged` (cut short, foreign, altered), `state_version` (of another
// format or step version).
std::vector<std::byte> saved(const GuidanceState& state);
base::Result<GuidanceState> restored_guidance(std::span<const std::byte> bytes);

}  // namespace seldinger::session
