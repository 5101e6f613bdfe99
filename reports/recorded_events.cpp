#include "reports/recorded_events.h"

#include <algorithm>

namespace seldinger::reports {
namespace {

// A button as it stands in each tick; it is up before the first.
struct Button {
  const char* down;
  const char* up;
  bool (*is_down)(const cases::Inputs&);
};

constexpr Button kButtons[] = {
    {"freeze", "unfreeze", [](const cases::Inputs& in) { return in.freeze; }},
    {"pedal_down", "pedal_up", [](const cases::Inputs& in) { return in.fluoroscope.pedal; }}};

}  // namespace

const std::vector<EventKindInfo>& event_kinds() {
  static const std::vector<EventKindInfo> kinds = {{"fire", "the trigger fell: the endpoint"},
                                                   {"freeze", "the picture was frozen"},
                                                   {"unfreeze", "the picture went on"},
                                                   {"pedal_down", "the fluoroscope's pedal went down"},
                                                   {"pedal_up", "the fluoroscope's pedal went up"}};
  return kinds;
}

std::vector<RecordedEvent> recorded_events(const cases::Recording& recording) {
  std::vector<RecordedEvent> events;
  if (recording.endpoint) events.push_back({recording.endpoint->t_s, "fire"});
  for (const Button& button : kButtons) {
    bool was_down = false;
    for (std::size_t i = 0; i < recording.inputs.size(); ++i) {
      const bool down = button.is_down(recording.inputs[i]);
      if (down != was_down)
        events.push_back({static_cast<double>(i + 1) * recording.dt_s, down ? button.down : button.up});
      was_down = down;
    }
  }
  std::stable_sort(events.begin(), events.end(),
                   [](const RecordedEvent& a, const RecordedEvent& b) { return a.t_s < b.t_s; });
  return events;
}

}  // namespace seldinger::reports
