// Checks of a case in words, as a mentor reads them.
#include "reports/words/check_words.h"

#include <gtest/gtest.h>

namespace seldinger::reports {
namespace {

TEST(CheckWordsTest, NoIdIsLeft) {
  EXPECT_EQ(check_label("lesion_reachable"), "Free path");
  EXPECT_EQ(check_label("rule_possible"), "Rule can be met");
  EXPECT_EQ(check_label("of_tomorrow"), "of tomorrow");
  EXPECT_EQ(check_words({"rule_possible", false, "contradictory: the one and the other"}), "the one and the other");
  EXPECT_EQ(check_words({"rule_possible", true, "no criterion: none"}), "no criterion: none");
  EXPECT_EQ(check_words({"lesion_reachable", false, "lesion 1: no way"}), "lesion 1: no way");
}

}  // namespace
}  // namespace seldinger::reports
