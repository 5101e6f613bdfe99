// Φ of passing, from attempts that are not full by themselves.
#include "casedb/grading/dependability.h"

#include <gtest/gtest.h>

#include <cmath>

#include "sim/base/rng.h"
#include "tests/casedb/graded_library.h"
#include "tests/fixtures/until.h"

namespace seldinger::casedb {
namespace {

LearningAttempt attempt(const std::string& person, const std::string& family, bool passed) {
  LearningAttempt made;
  made.person_id = person;
  made.family_id = family;
  made.verdict = passed ? assessment::Verdict::passed : assessment::Verdict::failed;
  return made;
}

std::optional<double> named(const assessment::statistics::Answer& answer, const std::string& name) {
  for (const auto& one : answer.more)
    if (one.name == name) return one.value;
  return std::nullopt;
}

TEST(Dependability, TakesTheLargestFullTable) {
  std::vector<LearningAttempt> attempts;
  for (const char* person : {"a", "b", "c"})
    for (const char* family : {"1", "2"})
      for (int i = 0; i < 3; ++i) attempts.push_back(attempt(person, family, (person[0] + family[0] + i) % 2 == 0));
  attempts.push_back(attempt("a", "3", true));   // one person only
  attempts.push_back(attempt("d", "1", false));  // at one case only
  attempts.push_back(attempt("a", "1", true));
  attempts.back().verdict = assessment::Verdict::not_gradable;
  const auto table = dependability_table(attempts);
  EXPECT_EQ(table.rows, 12U) << "three persons, two cases, the last two occasions";
  EXPECT_EQ(table.x.size(), 12U);
  for (std::size_t i = 0; i < table.rows; ++i) {
    EXPECT_NE(table.subject[i], "d");
    EXPECT_NE(table.rater[i], "3");
  }
}

TEST(Dependability, IsRefusedUnderTwoCasesOrPersons) {
  EXPECT_FALSE(dependability({}).estimable());
  const std::vector<LearningAttempt> one_case = {attempt("a", "1", true), attempt("b", "1", false)};
  EXPECT_EQ(dependability(one_case).reason, "too_few");
  const std::vector<LearningAttempt> one_person = {attempt("a", "1", true), attempt("a", "2", false)};
  EXPECT_EQ(dependability(one_person).reason, "too_few");
  const std::vector<LearningAttempt> nothing_common = {attempt("a", "1", true), attempt("b", "2", false),
                                                       attempt("c", "3", false)};
  EXPECT_FALSE(dependability(nothing_common).estimable());
}

// Variances of passing are known: a person passes with a probability of their own, whatever the case.
TEST(Dependability, FindsThePlantedPhi) {
  constexpr std::size_t kCases = 6, kPersons = 60;
  int covered = 0, sets = 0;
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    base::Rng rng(seed);
    std::vector<LearningAttempt> attempts;
    for (std::size_t p = 0; p < kPersons; ++p) {
      const double share = rng.uniform();
      for (std::size_t c = 0; c < kCases; ++c)
        attempts.push_back(attempt("p" + std::to_string(p), "c" + std::to_string(c), rng.uniform() < share));
    }
    const auto answer = dependability(attempts);
    ASSERT_TRUE(answer.estimable());
    ASSERT_TRUE(answer.ci95.has_value());
    // Of a uniform share the variance is 1/12, that of chance E p (1 − p) = 1/6: Φ of six is 1/12 / (1/12 + 1/36).
    covered += answer.ci95->low <= 0.75 && 0.75 <= answer.ci95->high ? 1 : 0;
    ++sets;
    const auto needed = named(answer, "cases_for_phi");
    ASSERT_TRUE(needed.has_value());
    EXPECT_GT(*needed, 3.0);  // the truth is 8
    EXPECT_LT(*needed, 20.0);
  }
  EXPECT_GE(covered, 34) << "of " << sets;
}

class KeptDependabilityTest : public GradedLibrary {};

TEST_F(KeptDependabilityTest, IsRenewedOnceSomebodyHasStoredSomething) {
  rule({"hit >= 1"});
  const std::string tom = user("Tom", Role::trainee);
  KeptDependability kept;
  EXPECT_EQ(kept.of(library_).reason, "no_data");
  attempt(tom, 1.0, 20.0);
  // Of a small library soon, of a large one later.
  EXPECT_TRUE(fixtures::until([&] { return kept.of(library_).reason == "too_few"; }));
  Library other = open_library(library_.folder());
  KeptDependability others;
  EXPECT_EQ(others.of(other).n, 1U);
  attempt(user("Tina", Role::trainee), 0.0, 20.0);
  EXPECT_TRUE(fixtures::until([&] { return others.of(other).n == 2U; })) << "by another connection";
}

}  // namespace
}  // namespace seldinger::casedb
