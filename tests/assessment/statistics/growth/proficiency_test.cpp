// Proficiency as a probability: R's beta distribution, every sequence of passes, and learners that are made up.
#include "assessment/statistics/growth/proficiency.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>

#include "sim/base/rng.h"
#include "tests/assessment/statistics/growth/numbers_of.h"
#include "tests/assessment/statistics/r_oracle.h"

namespace seldinger::assessment::statistics {
namespace {

using fixtures::number_of;

DataTable passes(const std::string& letters, const std::string& person = {}) {
  DataTable table;
  table.rows = letters.size();
  table.values.push_back({"passed", {}});
  for (const char letter : letters) table.values.front().values.push_back(letter == 'P' ? 1.0 : 0.0);
  if (!person.empty()) table.subject.assign(table.rows, person);
  return table;
}

TEST(Proficiency, IsTheBetaDistributionsOfR) {
  SELDINGER_NEEDS_R();
  base::Rng rng(fixtures::r_seed());
  std::string script;
  struct Asked {
    std::size_t passes, attempts;
    double share;
  };
  std::vector<Asked> all;
  for (std::size_t i = 0; i < fixtures::r_sets(); ++i) {
    const auto attempts = static_cast<std::size_t>(1.0 + 40.0 * rng.uniform());
    const auto passed = static_cast<std::size_t>(static_cast<double>(attempts + 1) * rng.uniform());
    all.push_back({passed, attempts, 0.05 + 0.9 * rng.uniform()});
    char line[160];
    std::snprintf(line, sizeof line, "say(\"p%zu\", pbeta(%.17g, %zu + 0.5, %zu + 0.5, lower.tail = FALSE))\n", i,
                  all.back().share, passed, attempts - passed);
    script += line;
  }
  auto said =
      fixtures::r_values(script + "say(\"low\", qbeta(0.025, 9.5, 1.5)); say(\"high\", qbeta(0.975, 9.5, 1.5))");
  for (std::size_t i = 0; i < all.size(); ++i) {
    const double got = probability_of_share(all[i].passes, all[i].attempts, all[i].share);
    const double want = said["p" + std::to_string(i)];
    fixtures::note_difference(got, want);
    EXPECT_NEAR(got, want, 1e-9);
  }
  const Answer answer = proficiency(passes("FFFFPPPPPPPPPF"), ProficiencyRule());  // 9 of the last 10
  EXPECT_NEAR(number_of(answer, "share_low"), said["low"], 1e-9);
  EXPECT_NEAR(number_of(answer, "share_high"), said["high"], 1e-9);
}

TEST(Proficiency, TwoRunningIsCountedOverEverySequence) {
  for (const double p : {0.0, 0.3, 0.5, 0.9, 1.0})
    for (const std::size_t attempts : {0U, 1U, 2U, 5U, 11U}) {
      double sum = 0.0;
      for (unsigned sequence = 0; sequence < (1U << attempts); ++sequence)
        if ((sequence & (sequence >> 1U)) != 0)
          sum += std::pow(p, std::popcount(sequence)) *
                 std::pow(1.0 - p, static_cast<double>(attempts) - std::popcount(sequence));
      EXPECT_NEAR(two_running(p, attempts), sum, 1e-12) << p << ' ' << attempts;
    }
}

TEST(Proficiency, OnlyTheLastAttemptsCount) {
  const Answer late = proficiency(passes("FFFFFFFFFFPPPPPPPPPP"), ProficiencyRule());
  const Answer alone = proficiency(passes("PPPPPPPPPP"), ProficiencyRule());
  EXPECT_EQ(late.estimate, alone.estimate);
  EXPECT_GT(late.estimate.value(), 0.9);
  EXPECT_EQ(number_of(late, "proficient"), 1.0);
  EXPECT_EQ(number_of(late, "passes"), 10.0);
  ASSERT_EQ(late.rows.size(), 20U);
  EXPECT_EQ(number_of(late, "reached_at"), 20.0) << "nine of ten are not sure enough";
  // Two passes in a row are the rule of old, and prove little.
  EXPECT_LT(proficiency(passes("FPP"), ProficiencyRule()).estimate.value(), 0.5);
}

TEST(Proficiency, MorePassesAreNeverLessSure) {
  for (std::size_t attempts = 1; attempts <= 30; ++attempts)
    for (std::size_t passed = 1; passed <= attempts; ++passed)
      EXPECT_GE(probability_of_share(passed, attempts, 0.8), probability_of_share(passed - 1, attempts, 0.8));
}

// Of learners whose share is drawn from the prior, those called so sure are right as often as is said.
TEST(Proficiency, IsRightAsOftenAsItSays) {
  base::Rng rng(7);
  int sure = 0, right = 0;
  for (int i = 0; i < 40'000; ++i) {
    const double share = std::pow(std::sin(1.5707963267948966 * rng.uniform()), 2.0);  // Jeffreys' prior
    std::size_t passed = 0;
    for (int k = 0; k < 10; ++k) passed += rng.uniform() < share ? 1 : 0;
    if (probability_of_share(passed, 10, 0.8) < 0.9) continue;
    ++sure;
    right += share >= 0.8 ? 1 : 0;
  }
  ASSERT_GT(sure, 1000);
  const double expected = probability_of_share(10, 10, 0.8), got = static_cast<double>(right) / sure;
  EXPECT_NEAR(got, expected, 3.0 * std::sqrt(expected * (1.0 - expected) / sure));
}

TEST(Proficiency, IsRefusedWithAReason) {
  EXPECT_EQ(proficiency(passes(""), ProficiencyRule()).reason, "no_data");
  DataTable odd = passes("PF");
  odd.values.front().values[0] = 2.0;
  EXPECT_EQ(proficiency(odd, ProficiencyRule()).reason, "bad_value");
  EXPECT_EQ(proficiency(passes("P"), {.share = 1.0}).reason, "bad_value");
}

TEST(Proficiency, TellsSeveralPersonsApart) {
  DataTable table = passes("PPPPPPPPPPFFFF");
  for (std::size_t i = 0; i < table.rows; ++i) table.subject.push_back(i < 10 ? "good" : "new");
  const Answer answer = proficiency(table, ProficiencyRule());
  EXPECT_EQ(number_of(answer, "persons_proficient"), 1.0);
  EXPECT_EQ(number_of(answer, "good", "reached_at"), 6.0) << "six passes in a row, and not five";
  EXPECT_LT(number_of(answer, "new", "probability"), 0.01);
}

}  // namespace
}  // namespace seldinger::assessment::statistics
