#include "session/attempt/replayed_attempt.h"

#include <optional>
#include <vector>

#include "sim/engine/step.h"
#include "sim/engine/tick.h"

namespace seldinger::session {
namespace {

// The events that come of the inputs again.
std::vector<cases::Event> not_noted(const cases::Recording& recording) {
  std::vector<cases::Event> events = recording.events.value_or(std::vector<cases::Event>{});
  std::erase_if(events, [](const cases::Event& event) {
    const cases::EventInfo* info = cases::find_event(event.kind);
    return info != nullptr && info->noted;
  });
  return events;
}

}  // namespace

Replay replay(const cases::Case& scene, const cases::Recording& recording, const TickSeen& seen) {
  const bool comparable = recording.step_version == engine::kStepVersion;
  const engine::Tick whole(scene);
  engine::TickState now;
  std::vector<cases::Event> events;
  const std::vector<cases::Event> made_again = not_noted(recording);
  std::size_t poses = 0;
  std::optional<cases::Endpoint> endpoint;
  const auto is_next = [](const auto& rows, std::size_t at, const auto& row) {
    return at < rows.size() && rows[at] == row;
  };
  for (std::size_t i = 0; i < recording.inputs.size(); ++i) {
    const cases::RecordedTick tick = whole.advance(recording.inputs[i], recording.dt_s, now);
    const std::size_t told = events.size();
    cases::add_events(now.state.t_s, tick, events);
    if (tick.endpoint) endpoint = tick.endpoint;
    bool same = tick.hash == recording.hashes[i];
    if (tick.pose) {
      same = same && is_next(recording.poses, poses, *tick.pose);
      if (tick.force && !recording.forces.empty()) same = same && is_next(recording.forces, poses, *tick.force);
      ++poses;
    }
    for (std::size_t e = told; recording.events && e < events.size(); ++e)
      same = same && is_next(made_again, e, events[e]);
    if (!same && comparable) return {false, now.state.tick};
    if (seen) seen(now.state, now.displacement);
  }
  if (!comparable) return {false, 0};
  const bool events_same = !recording.events || made_again.size() == events.size();
  return {poses == recording.poses.size() && endpoint == recording.endpoint && events_same, now.state.tick};
}

}  // namespace seldinger::session
