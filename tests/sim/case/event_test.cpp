// Tests of sim/case/event.
#include "sim/case/event.h"

#include <gtest/gtest.h>

#include <set>
#include <string>

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

}  // namespace
}  // namespace seldinger::cases
