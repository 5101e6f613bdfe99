// Φ in words: the numbers, why there are none, and that few people are not told of.
#include "reports/words/dependability_words.h"

#include <gmock/gmock.h>

namespace seldinger::reports {
namespace {

using casedb::Learners;
using ::testing::HasSubstr;
using ::testing::Not;

assessment::statistics::Answer answer(std::size_t persons) {
  assessment::statistics::Answer made;
  made.test = "g_theory";
  made.n = persons;
  made.estimate = 0.62;
  made.ci95 = assessment::statistics::Interval{0.2, 0.8};
  made.more = {{"cases", 4.0}, {"occasions", 2.0}, {"phi_one_case", 0.29}, {"cases_for_phi", 10.0}};
  return made;
}

TEST(DependabilityWords, SayHowManyCasesADecisionTakes) {
  EXPECT_EQ(
      dependability_text(answer(7), Learners::people),
      "One case alone decides about a person with a dependability Φ of 0.29, 4 cases together with 0.62 (95 % "
      "interval 0.20 to 0.80); 7 persons, each case on 2 occasions. For 0.8 it takes 10 cases.");
  auto endless = answer(7);
  endless.more.pop_back();
  EXPECT_THAT(dependability_text(endless, Learners::people), HasSubstr("more than any number of cases"));
}

TEST(DependabilityWords, AreOneSentenceWhereThereIsRoomForOne) {
  EXPECT_EQ(dependability_line(answer(7), Learners::people),
            "Passing one case decides about a person with a dependability Φ of 0.29; 0.8 takes 10 cases.");
  auto endless = answer(7);
  endless.more.pop_back();
  EXPECT_THAT(dependability_line(endless, Learners::people), HasSubstr("takes more than any number of cases."));
  EXPECT_THAT(dependability_line(answer(4), Learners::people), HasSubstr("fewer than five people"));
  EXPECT_THAT(dependability_line(assessment::statistics::not_estimable("g_theory", "too_few", 1), Learners::people),
              HasSubstr("not known yet"));
}

TEST(DependabilityWords, TellNothingOfFewPeople) {
  EXPECT_TRUE(withheld(answer(4), Learners::people));
  EXPECT_THAT(dependability_text(answer(4), Learners::people), Not(HasSubstr("0.29")));
  EXPECT_THAT(dependability_text(answer(4), Learners::simulated), HasSubstr("0.29"));
}

TEST(DependabilityWords, SayWhyThereIsNone) {
  const auto none = assessment::statistics::not_estimable("g_theory", "too_few", 1);
  EXPECT_THAT(dependability_text(none, Learners::people), HasSubstr("there are too few values"));
  EXPECT_FALSE(withheld(none, Learners::people));
}

}  // namespace
}  // namespace seldinger::reports
