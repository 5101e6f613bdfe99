// What was typed, as messages show it and as it may have been meant.
#include "app/cli/words.h"

#include <gtest/gtest.h>

#include "app/cli/arguments.h"
#include "app/cli/command.h"

namespace seldinger::app {
namespace {

const std::vector<std::string> kWords = {"train", "trace", "case list", "--library", "mentor"};

TEST(Words, WhatIsTypedCannotForgeALineOrCommandATerminal) {
  EXPECT_EQ(shown("a b"), "\"a b\"");
  EXPECT_EQ(shown("x\nerror: y"), "\"x?error: y\"");
  EXPECT_EQ(shown("\x1b[2J\x7f"), "\"?[2J?\"");
  EXPECT_EQ(shown("\xC2\x9B\x32J"), "\"?2J\"") << "the control sequence introducer in UTF-8";
  EXPECT_EQ(shown("Zürich"), "\"Zürich\"");
  EXPECT_EQ(shown(std::string(300, 'a')).size(), 200 + 2 + std::string("…").size());
}

TEST(Words, TheNearestNameIsMeantAndNoOther) {
  EXPECT_EQ(nearest("trian", kWords), "train");
  EXPECT_EQ(nearest("tran", kWords), "train") << "one letter is lost";
  EXPECT_EQ(nearest("case lst", kWords), "case list");
  EXPECT_EQ(nearest("--libary", kWords), "--library");
  EXPECT_EQ(nearest("--lib", kWords), "--library") << "its only continuation";
  EXPECT_EQ(nearest("men", kWords), "mentor");
  EXPECT_FALSE(nearest("tra", kWords)) << "two go on so";
  EXPECT_FALSE(nearest("traie", kWords)) << "one change from train, one from trace";
  EXPECT_FALSE(nearest("needle", kWords));
  EXPECT_FALSE(nearest("", kWords));
  EXPECT_EQ(did_you_mean("needle", kWords), "");
}

constexpr Option kChoosing[] = {
    {"--way", "in|out", ""}, {"--who", "expert|FILE.json", ""}, {"--hu", "H|as_ct", ""}};
const Command kChooser{.name = "go",
                       .positionals = "CASE [FILE]",
                       .min_positionals = 1,
                       .max_positionals = 2,
                       .options = kChoosing,
                       .summary = "",
                       .run = nullptr};

std::string usage_of(const std::vector<std::string>& words) {
  try {
    const Arguments arguments(kChooser, words);
    return "";
  } catch (const UsageError& error) {
    return error.what();
  }
}

TEST(Arguments, ChoicesAreCheckedAgainstTheirOptionsRow) {
  EXPECT_EQ(usage_of({"a", "--way", "in"}), "");
  EXPECT_EQ(usage_of({"a", "--way", "ouf"}), "--way is in or out, not \"ouf\"; did you mean out?");
  EXPECT_EQ(usage_of({"a", "--who", "me.json"}), "");
  EXPECT_EQ(usage_of({"a", "--who", "exprt"}), "--who is expert or FILE.json, not \"exprt\"; did you mean expert?");
  EXPECT_EQ(usage_of({"a", "--hu", "7"}), "") << "H is free";
  EXPECT_EQ(usage_of({}), "CASE is missing");
  EXPECT_EQ(usage_of({"a", "b", "c d"}), "\"c d\" is one word too many");
  EXPECT_EQ(usage_of({"a", "--wya", "in"}), "there is no option \"--wya\"; did you mean --way?");
}

TEST(Arguments, WhatIsCalledBecomesItsId) {
  const Arguments arguments(kChooser, {"liver"});
  ASSERT_EQ(arguments.names("CASE").size(), 1U);
  EXPECT_TRUE(arguments.names("FILE").empty()) << "it was not given";
  EXPECT_EQ(arguments.names("CASE")[0].typed, "liver");
  arguments.settle(arguments.names("CASE")[0], "01a2");
  EXPECT_EQ(arguments.positional(0), "01a2");
}

constexpr Option kCases[] = {{"--case", "CASE", "a case", true}};
const Command kMany{.name = "many", .options = kCases, .summary = "", .run = nullptr};

TEST(Arguments, EachValueOfAnOptionBecomesItsOwnId) {
  const Arguments arguments(kMany, {"--case", "liver", "--case", "spleen"});
  const auto called = arguments.names("CASE");
  ASSERT_EQ(called.size(), 2U);
  EXPECT_EQ(called[1].typed, "spleen");
  arguments.settle(called[0], "01a2");
  EXPECT_EQ(arguments.all("--case"), (std::vector<std::string>{"01a2", "spleen"}));
  arguments.settle(called[1], "01b3");
  EXPECT_EQ(arguments.all("--case"), (std::vector<std::string>{"01a2", "01b3"}));
}

}  // namespace
}  // namespace seldinger::app
