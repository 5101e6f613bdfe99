// Events out of a recording: the instants at which buttons change, and that the list of kinds has each.
#include "reports/recorded_events.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace seldinger::reports {
namespace {

TEST(RecordedEvents, ButtonsAndTrigger) {
  cases::Recording recording;
  recording.dt_s = 0.5;
  recording.inputs.resize(6);
  recording.inputs[1].freeze = recording.inputs[2].freeze = true;
  recording.inputs[4].fluoroscope.pedal = true;
  recording.endpoint = cases::Endpoint{1.75, {}, {}};
  const auto events = recorded_events(recording);
  const std::vector<std::pair<double, std::string>> expected = {
      {1.0, "freeze"}, {1.75, "fire"}, {2.0, "unfreeze"}, {2.5, "pedal_down"}, {3.0, "pedal_up"}};
  ASSERT_EQ(events.size(), expected.size());
  for (std::size_t i = 0; i < events.size(); ++i) {
    EXPECT_EQ(events[i].t_s, expected[i].first);
    EXPECT_EQ(events[i].kind, expected[i].second);
    EXPECT_TRUE(std::any_of(event_kinds().begin(), event_kinds().end(),
                            [&](const EventKindInfo& kind) { return kind.kind == events[i].kind; }));
  }
  EXPECT_TRUE(recorded_events({}).empty());
}

}  // namespace
}  // namespace seldinger::reports
