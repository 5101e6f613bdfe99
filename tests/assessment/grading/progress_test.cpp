// Proficiency over every short run of verdicts, and gates, limits and what is due.
#include "assessment/grading/progress.h"

#include <gtest/gtest.h>

namespace seldinger::assessment {
namespace {

using enum Verdict;

// Said another way: proficient when, without what is not graded, "pp" stands in the letters.
Proficiency by_letters(const std::vector<Verdict>& verdicts) {
  std::string letters;
  for (const Verdict verdict : verdicts)
    if (verdict == passed || verdict == failed) letters += verdict == passed ? 'p' : 'f';
  if (letters.find("pp") != letters.npos) return Proficiency::proficient;
  if (letters.find('p') != letters.npos) return Proficiency::passed;
  return verdicts.empty() ? Proficiency::not_started : Proficiency::practising;
}

TEST(ProgressTest, ProficientIsTwoPassesRunningInEveryRunOfUpToSix) {
  constexpr Verdict kAll[] = {passed, failed, not_gradable, no_rule};
  for (int length = 0, runs = 1; length <= 6; ++length, runs *= 4)
    for (int run = 0; run < runs; ++run) {
      std::vector<Verdict> verdicts;
      for (int i = 0, rest = run; i < length; ++i, rest /= 4) verdicts.push_back(kAll[rest % 4]);
      EXPECT_EQ(proficiency_of(verdicts), by_letters(verdicts)) << length << " " << run;
      const int missing = passes_missing(verdicts);
      std::vector<Verdict> on = verdicts;
      on.insert(on.end(), static_cast<std::size_t>(missing), passed);
      EXPECT_EQ(by_letters(on), Proficiency::proficient) << length << " " << run;
      if (missing == 0) continue;
      on.pop_back();
      EXPECT_NE(by_letters(on), Proficiency::proficient) << "fewer would do: " << length << " " << run;
    }
}

TEST(ProgressTest, GatesOpenWithWhatTheyAskFor) {
  std::vector<ItemPast> items(3);
  items[1].gates = {{0, Proficiency::passed}};
  items[2].gates = {{0, Proficiency::proficient}, {1, Proficiency::passed}};
  auto progress = progress_of(items);
  EXPECT_TRUE(progress[0].open && progress[0].due);
  EXPECT_FALSE(progress[1].open || progress[2].open || progress[1].due || progress[2].due);
  items[0].verdicts = {passed};
  progress = progress_of(items);
  EXPECT_TRUE(progress[0].due) << "passed is not yet proficient";
  EXPECT_TRUE(progress[1].open);
  EXPECT_FALSE(progress[1].due);
  EXPECT_FALSE(progress[2].open);
  items[0].verdicts = {passed, passed};
  items[1].verdicts = {passed};
  progress = progress_of(items);
  EXPECT_TRUE(progress[2].open);
  EXPECT_TRUE(progress[1].due);
  items[1].verdicts = items[2].verdicts = {passed, passed};
  for (const ItemProgress& one : progress_of(items)) EXPECT_FALSE(one.due);
}

TEST(ProgressTest, WhatCannotBeAttemptedIsNotDue) {
  std::vector<ItemPast> items(3);
  items[0].limit = 2;
  items[0].begun = 2;
  items[1].available = false;
  auto progress = progress_of(items);
  EXPECT_EQ(progress[0].attempts_left, 0);
  EXPECT_FALSE(progress[0].due || progress[1].due);
  EXPECT_TRUE(progress[2].due);
  EXPECT_FALSE(progress[2].attempts_left.has_value());
  items[0].begun = 1;
  EXPECT_EQ(progress_of(items)[0].attempts_left, 1);
  items[0].begun = 9;
  EXPECT_EQ(progress_of(items)[0].attempts_left, 0);
}

TEST(ProgressTest, NamesComeBack) {
  for (const auto one :
       {Proficiency::not_started, Proficiency::practising, Proficiency::passed, Proficiency::proficient})
    EXPECT_EQ(proficiency_from(name_of(one)), one);
  EXPECT_FALSE(proficiency_from("Passed").has_value());
}

}  // namespace
}  // namespace seldinger::assessment
