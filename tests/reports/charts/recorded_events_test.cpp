// Events out of a recording: the instants at which buttons change, and what was said and happened.
#include "reports/charts/recorded_events.h"

#include <gtest/gtest.h>

namespace seldinger::reports {
namespace {

TEST(RecordedEvents, ButtonsTriggerAndWhatHappened) {
  cases::Recording recording;
  recording.dt_s = 0.5;
  recording.inputs.resize(6);
  recording.inputs[1].freeze = recording.inputs[2].freeze = true;
  recording.inputs[4].fluoroscope.pedal = true;
  recording.endpoint = cases::Endpoint{1.75, {}, {}};
  recording.events = {{0.25, cases::EventKind::sign_in}, {1.8, cases::EventKind::cough}};
  const auto events = recorded_events(recording);
  struct Expected {
    double t_s;
    std::string kind, source;
  };
  const std::vector<Expected> expected = {
      {0.25, "sign_in", "trainee"}, {1.0, "freeze", "hand"},     {1.75, "fire", "hand"},   {1.8, "cough", "mentor"},
      {2.0, "unfreeze", "hand"},    {2.5, "pedal_down", "hand"}, {3.0, "pedal_up", "hand"}};
  ASSERT_EQ(events.size(), expected.size());
  for (std::size_t i = 0; i < events.size(); ++i) {
    EXPECT_EQ(events[i].t_s, expected[i].t_s);
    EXPECT_EQ(events[i].info->kind, expected[i].kind);
    EXPECT_EQ(events[i].info->source, expected[i].source);
    EXPECT_FALSE(events[i].info->words.empty() || events[i].info->about.empty());
  }
  EXPECT_TRUE(recorded_events({}).empty());
}

}  // namespace
}  // namespace seldinger::reports
