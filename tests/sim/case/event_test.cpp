// Tests of sim/case/event.
#include "sim/case/event.h"

#include <gtest/gtest.h>

#include <limits>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "sim/case/hand_kind.h"

namespace seldinger::cases {
namespace {

TEST(Events, EachHasItsNumberAndItsName) {
  std::set<std::string> names;
  std::set<int> numbers;
  for (const EventInfo& info : event_kinds()) {
    EXPECT_TRUE(names.insert(info.name).second) << info.name;
    EXPECT_TRUE(numbers.insert(static_cast<int>(info.kind)).second) << info.name;
    EXPECT_EQ(find_event(info.kind), &info);
    EXPECT_EQ(event_from(info.name), info.kind);
    // The ranges by which a reader of recordings may know whose an unknown one would be.
    const int number = static_cast<int>(info.kind);
    EXPECT_EQ(name_of(info.source), number < 32   ? "trainee"
                                    : number < 64 ? "mentor"
                                    : number < 96 ? "patient"
                                                  : "workstation")
        << info.name;
  }
  EXPECT_EQ(find_event(EventKind::none), nullptr);
  EXPECT_EQ(find_event(static_cast<EventKind>(250)), nullptr);
  EXPECT_EQ(event_from("none"), std::nullopt);
  EXPECT_EQ(event_from(""), std::nullopt);
}

TEST(Events, WhatTheRecorderNotesIsTheWorkstations) {
  for (const EventInfo& info : event_kinds())
    if (info.noted || info.snaps) {
      EXPECT_EQ(info.source, EventSource::workstation) << info.name;
    }
  EXPECT_FALSE(find_event(EventKind::resumed)->noted) << "it is an input of the attempt that goes on";
}

TEST(Events, TellWhenTheProgramMovesAToolItself) {
  using enum EventKind;
  EXPECT_TRUE(program_moves({}).empty());
  const Event events[] = {{0.001, needle_by_mouse}, {1.0, sign_in},      {2.0, guide_on},     {2.5, guide_reached},
                          {3.0, guide_off},         {4.0, paused, 30.0}, {5.0, return_begun}, {5.5, guide_on}};
  const std::vector<EventSpan> moves = program_moves(events);
  const double end_s = std::numeric_limits<double>::infinity();
  const std::vector<std::pair<double, double>> expected = {{0.001, 0.001}, {2.0, 2.5}, {2.5, 2.5},
                                                           {4.0, 4.0},     {5.0, 5.5}, {5.5, end_s}};
  ASSERT_EQ(moves.size(), expected.size());
  for (std::size_t i = 0; i < moves.size(); ++i) {
    EXPECT_EQ(moves[i].from_s, expected[i].first) << i;
    EXPECT_EQ(moves[i].to_s, expected[i].second) << i;
  }
}

TEST(Events, TellWhenTheNeedleWasGuided) {
  using enum EventKind;
  EXPECT_TRUE(guided_times({}).empty());
  const Event events[] = {{0.5, guide_off}, {1.0, guide_on}, {1.5, guide_reached}, {3.0, guide_off},
                          {4.0, guide_on},  {6.0, resumed},  {7.0, guide_on}};
  const std::vector<EventSpan> times = guided_times(events);
  ASSERT_EQ(times.size(), 3U);
  EXPECT_EQ(times[0].from_s, 1.0);
  EXPECT_EQ(times[0].to_s, 3.0);
  EXPECT_EQ(times[1].to_s, 6.0) << "who goes on takes the tools up without a guide";
  EXPECT_EQ(times[2].to_s, std::numeric_limits<double>::infinity());
}

TEST(Events, WhatLeadsAToolHasAnEventForEachHand) {
  for (const LedTool tool : {LedTool::needle, LedTool::probe})
    for (const auto& hand : kHandKindNames) {
      const EventKind kind = led_by(tool, hand.value);
      if (hand.value == HandKind::simulated) {
        EXPECT_EQ(kind, EventKind::none);
        continue;
      }
      ASSERT_TRUE(led_by(kind)) << hand.name;
      EXPECT_EQ(led_by(kind)->tool, tool);
      EXPECT_EQ(led_by(kind)->hand, hand.value);
      EXPECT_TRUE(find_event(kind)->noted && find_event(kind)->snaps);
    }
  EXPECT_FALSE(led_by(EventKind::paused));
}

}  // namespace
}  // namespace seldinger::cases
