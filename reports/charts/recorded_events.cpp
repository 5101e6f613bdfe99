#include "reports/charts/recorded_events.h"

#include <algorithm>
#include <string_view>

#include "sim/base/check.h"
#include "sim/case/event.h"

namespace seldinger::reports {
namespace {

constexpr const char* kHand = "hand";

// A button as it stands in each tick; it is up before the first.
struct Button {
  const char* down;
  const char* up;
  bool (*is_down)(const cases::Inputs&);
};

constexpr Button kButtons[] = {
    {"freeze", "unfreeze", [](const cases::Inputs& in) { return in.freeze; }},
    {"pedal_down", "pedal_up", [](const cases::Inputs& in) { return in.fluoroscope.pedal; }}};

const RecordedEventInfo* info_of(std::string_view kind) {
  for (const RecordedEventInfo& info : recorded_event_kinds())
    if (info.kind == kind) return &info;
  CHECK(false);
}

}  // namespace

const std::vector<RecordedEventInfo>& recorded_event_kinds() {
  static const std::vector<RecordedEventInfo> kinds = [] {
    std::vector<RecordedEventInfo> all = {{"fire", kHand, "fired", "the trigger was pressed: the endpoint"},
                                          {"freeze", kHand, "froze the picture", "the picture was frozen"},
                                          {"unfreeze", kHand, "let the picture go on", "the picture went on"},
                                          {"pedal_down", kHand, "pedal down", "the fluoroscope's pedal went down"},
                                          {"pedal_up", kHand, "pedal up", "the fluoroscope's pedal went up"}};
    for (const cases::EventInfo& info : cases::event_kinds())
      all.push_back({info.name, std::string(cases::name_of(info.source)), info.words, info.about});
    return all;
  }();
  return kinds;
}

std::vector<RecordedEvent> recorded_events(const cases::Recording& recording) {
  std::vector<RecordedEvent> events;
  if (recording.endpoint) events.push_back({recording.endpoint->t_s, info_of("fire")});
  for (const Button& button : kButtons) {
    bool was_down = false;
    for (std::size_t i = 0; i < recording.inputs.size(); ++i) {
      const bool down = button.is_down(recording.inputs[i]);
      if (down != was_down)
        events.push_back({static_cast<double>(i + 1) * recording.dt_s, info_of(down ? button.down : button.up)});
      was_down = down;
    }
  }
  if (recording.events)
    for (const cases::Event& event : *recording.events)
      if (const cases::EventInfo* known = cases::find_event(event.kind))
        events.push_back({event.t_s, info_of(known->name),
                          event.kind == cases::EventKind::paused ? std::optional(event.wall_s) : std::nullopt,
                          event.length_mm()});
  std::stable_sort(events.begin(), events.end(),
                   [](const RecordedEvent& a, const RecordedEvent& b) { return a.t_s < b.t_s; });
  return events;
}

}  // namespace seldinger::reports
