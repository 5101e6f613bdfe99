#include "sim/case/record/recorded_tick.h"

namespace seldinger::cases {

PoseSample pose_of(const State& state) {
  return {state.t_s,         state.needle.tip_lps_mm, state.needle.direction, state.probe.origin_lps_mm,
          state.probe.axial, state.probe.lateral};
}

void add_events(double t_s, const RecordedTick& tick, std::vector<Event>& events) {
  if (tick.inputs.event != EventKind::none)
    events.push_back({t_s, tick.inputs.event, 0.0, tick.inputs.event_tenths_mm});
  if (tick.reaction != EventKind::none) events.push_back({t_s, tick.reaction});
  if (tick.noted != EventKind::none) events.push_back({t_s, tick.noted, tick.noted_wall_s});
}

}  // namespace seldinger::cases
