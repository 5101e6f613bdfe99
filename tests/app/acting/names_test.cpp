// Ids by their beginnings and titles. That nobody learns by them what they may not see: acting_test.cpp.
#include "app/acting/names.h"

#include <gtest/gtest.h>

namespace seldinger::app {
namespace {

const std::vector<Called> kKnown = {
    {"01a2-b1", "Liver"}, {"01a2-c7", "Liver, between ribs"}, {"77f0-00", "01A2 deep"}};

std::string id(const std::string& typed) {
  const auto found = id_of(typed, kKnown);
  return found ? *found : found.error().code;
}

TEST(Names, AreIdsTitlesOrTheirOnlyBeginning) {
  EXPECT_EQ(id("01a2-b1"), "01a2-b1");
  EXPECT_EQ(id("01a2-b"), "01a2-b1");
  EXPECT_EQ(id("77f0"), "77f0-00");
  EXPECT_EQ(id("7"), "77f0-00") << "however short";
  EXPECT_EQ(id("0"), "ambiguous");
  EXPECT_EQ(id("liver"), "01a2-b1") << "the whole title is before what only begins so";
  EXPECT_EQ(id("Liver, b"), "01a2-c7");
  EXPECT_EQ(id("live"), "ambiguous");
  EXPECT_EQ(id("01A2"), "ambiguous") << "two ids, and the title of a third, begin so";
  EXPECT_EQ(id("spleen"), "");
  EXPECT_EQ(id(""), "") << "an unset variable of a shell is no beginning";
}

TEST(Names, SaysWhichOnesItMayBe) {
  EXPECT_EQ(id_of("01a2", kKnown).error().text, "3 are called so or begin so: 01a2-b1, 01a2-c7, 77f0-00");
}

}  // namespace
}  // namespace seldinger::app
