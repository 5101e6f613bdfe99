// What one tick leaves behind: what a recording keeps of it.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "sim/case/inputs.h"
#include "sim/case/record/recording.h"
#include "sim/case/state.h"

namespace seldinger::cases {

// Poses and forces are kept at 100 Hz.
constexpr std::uint64_t kPoseTicks = 10;

struct RecordedTick {
  Inputs inputs;
  std::uint32_t hash = 0;                // low word of the chained state hash
  std::optional<PoseSample> pose{};      // every kPoseTicks
  std::optional<ForceSample> force{};    // as the pose, where anything can be felt
  EventKind reaction = EventKind::none;  // the patient's; what was asked for is in the inputs
  std::optional<Endpoint> endpoint{};
  EventKind noted = EventKind::none;  // by the recorder (EventInfo::noted), beside the inputs
  double noted_wall_s = 0.0;          // as Event::wall_s
};

PoseSample pose_of(const State& state);

// What was asked for in a tick that ended at t_s, then the reaction, then what was noted.
void add_events(double t_s, const RecordedTick& tick, std::vector<Event>& events);

}  // namespace seldinger::cases
