// Intraclass correlations against Shrout and Fleiss's published table, and psych of R on random data.
#include "assessment/statistics/reliability/icc.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

#include "tests/assessment/statistics/r_oracle.h"
#include "tests/assessment/statistics/reliability/score_tables.h"

namespace seldinger::assessment::statistics {
namespace {

using fixtures::number_of;

// Psychol. Bull. 86 (1979), table 2.
const fixtures::Rows kShroutFleiss = {{9, 2, 5, 8}, {6, 1, 3, 2},  {8, 4, 6, 8},
                                      {7, 1, 2, 6}, {10, 5, 6, 9}, {6, 2, 4, 7}};

void expect_icc(double got, double want, double tolerance = 1e-9) {
  fixtures::note_difference(got, want);
  EXPECT_LE(std::abs(got - want), tolerance * std::abs(want)) << got << " for " << want;
}

TEST(Icc, IsThatOfShroutAndFleiss) {
  const Answer answer = icc(complete_table(fixtures::long_table(kShroutFleiss)), 1);
  ASSERT_TRUE(answer.estimable());
  const double want[6][3] = {
      {.165741768405, -.132932324875, .722560062328}, {.289763779528, .0187865133747, .761084369649},
      {.714840714841, .342464765034, .945858259955},  {.442797133679, -.884442155238, .912415420341},
      {.620050547599, .071136815303, .927232040168},  {.909315542377, .675674713816, .985891678167}};
  ASSERT_EQ(answer.rows.size(), 6u);
  for (std::size_t i = 0; i < 6; ++i) {
    expect_icc(number_of(answer.rows[i], "icc"), want[i][0], 1e-11);
    expect_icc(number_of(answer.rows[i], "ci95_low"), want[i][1], 1e-10);
    expect_icc(number_of(answer.rows[i], "ci95_high"), want[i][2], 1e-10);
  }
  expect_icc(*answer.estimate, .289763779528, 1e-11);
  expect_icc(answer.ci95->low, .0187865133747, 1e-11);
  expect_icc(*answer.statistic, 11.027247956403);
  expect_icc(*answer.p_value, 0.0001345665164843);
  expect_icc(number_of(answer, "ms_subjects"), 11.2416667, 1e-8);
  expect_icc(number_of(answer, "ms_raters"), 32.4861111, 1e-8);
  expect_icc(number_of(answer, "ms_error"), 1.0194444, 1e-7);
  EXPECT_EQ(answer.n, 6u);
  EXPECT_EQ(answer.missing, 0u);
}

TEST(Icc, ReadsColumnsAsRaters) {
  const Answer wide = icc(fixtures::scores(kShroutFleiss), 2),
               tall = icc(complete_table(fixtures::long_table(kShroutFleiss)), 2);
  EXPECT_EQ(*wide.estimate, *tall.estimate);
  EXPECT_EQ(wide.ci95, tall.ci95);
}

TEST(Icc, TellsWhatOneScoreIsWrongBy) {
  const MeasurementError error = measurement_error(10.0, 0.93);
  expect_icc(error.sem, 2.64575131106);
  expect_icc(error.mdc95, 7.33364847808);
}

TEST(Icc, LeavesOutAndCountsWhoLacksAScore) {
  DataTable table = fixtures::long_table(kShroutFleiss);
  table.values.front().values[2] = std::nan("");
  const Answer answer = icc(complete_table(table), 1);
  fixtures::Rows rest(kShroutFleiss.begin() + 1, kShroutFleiss.end());
  EXPECT_EQ(answer.n, 5u);
  EXPECT_EQ(answer.missing, 1u);
  EXPECT_EQ(*answer.estimate, *icc(fixtures::scores(rest), 1).estimate);
}

TEST(Icc, ShowsANegativeOneAsItIs) {
  const Answer answer = icc(fixtures::scores({{1, 5}, {5, 1}, {2, 4}, {4, 2}, {3, 3.5}}), 0);
  ASSERT_TRUE(answer.estimable());
  EXPECT_LT(*answer.estimate, -0.9);
  EXPECT_GE(*answer.estimate, -1.0);
  EXPECT_FALSE(answer.notes.empty());
}

TEST(Icc, RefusesWithAReason) {
  EXPECT_EQ(icc(fixtures::scores({{1, 2}}), 1).reason, "too_few");
  EXPECT_EQ(icc(fixtures::scores({{1}, {2}, {3}}), 1).reason, "too_few");
  EXPECT_EQ(icc(fixtures::scores({{2, 2}, {2, 2}}), 1).reason, "no_variation");
  EXPECT_EQ(icc(fixtures::scores({{1e300, 2}, {2, 3}}), 1).reason, "no_finite_answer");
  EXPECT_EQ(icc(fixtures::scores({{1e-320, 0}, {0, 1e-320}}), 1).reason, "no_finite_answer");
  DataTable twice = fixtures::long_table(kShroutFleiss);
  twice.rater[1] = twice.rater[0];
  EXPECT_EQ(icc(complete_table(twice), 1).reason, "repeated_subject");
}

TEST(Icc, HasNoIntervalWhereRatersDifferByAConstant) {
  const Answer answer = icc(fixtures::scores({{1, 2}, {2, 3}, {5, 6}}), 2);
  ASSERT_TRUE(answer.estimable());
  EXPECT_EQ(*answer.estimate, 1.0);
  EXPECT_FALSE(answer.ci95);
}

TEST(Icc, IsThatOfPsych) {
  SELDINGER_NEEDS_R();
  std::string script = "suppressMessages(library(psych))\n";
  std::vector<Answer> answers;
  for (std::size_t set = 0; set < fixtures::r_sets(); ++set) {
    base::Rng rng(fixtures::r_seed() + set);
    const std::size_t n = 4 + static_cast<std::size_t>(30 * rng.uniform()), k = 2 + set % 4;
    fixtures::Rows rows =
        fixtures::random_scores(rng.bits(), n, k, 2.0 * rng.uniform(), rng.uniform(), 1.0, set % 2 == 0);
    if (set % 3 == 0) rows[1][k - 1] = std::nan("");
    answers.push_back(icc(fixtures::scores(rows), 0));
    const std::string name = "s" + std::to_string(set) + "_";
    script += "m <- rbind(";
    for (std::size_t i = 0; i < n; ++i) script += (i > 0 ? "," : "") + fixtures::r_vector(rows[i]);
    script += ")\nr <- ICC(m[complete.cases(m), ], lmer = FALSE)$results\nfor (i in 1:6) { say(paste0('" + name +
              "icc', i), r$ICC[i]); say(paste0('" + name + "low', i), r[['lower bound']][i]); say(paste0('" + name +
              "high', i), r[['upper bound']][i]); say(paste0('" + name + "f', i), r$F[i]); say(paste0('" + name +
              "p', i), r$p[i]) }\n";
  }
  const std::map<std::string, double> want = fixtures::r_values(script);
  std::size_t of_rounding = 0;
  for (std::size_t set = 0; set < answers.size(); ++set) {
    SCOPED_TRACE(set);
    ASSERT_TRUE(answers[set].estimable());
    const std::string name = "s" + std::to_string(set) + "_";
    // Where subjects do not differ at all, or nothing but subjects does, R divides by what rounding leaves of 0.
    if (!(want.at(name + "f1") > 1e-12 && want.at(name + "f1") < 1e12 && want.at(name + "f2") < 1e12)) {
      ++of_rounding;
      continue;
    }
    for (std::size_t i = 0; i < 6; ++i) {
      const std::string number = std::to_string(i + 1);
      // Of an ICC near 0 it is the absolute difference that tells.
      EXPECT_LE(std::abs(number_of(answers[set].rows[i], "icc") - want.at(name + "icc" + number)), 1e-9);
      if (want.at(name + "low" + number) > want.at(name + "high" + number)) {
        // psych's ends change places where the lower one has no bound.
        EXPECT_TRUE(std::isnan(number_of(answers[set].rows[i], "ci95_low")));
        continue;
      }
      EXPECT_LE(std::abs(number_of(answers[set].rows[i], "ci95_low") - want.at(name + "low" + number)),
                1e-9 * std::max(1.0, std::abs(want.at(name + "low" + number))));
      EXPECT_LE(std::abs(number_of(answers[set].rows[i], "ci95_high") - want.at(name + "high" + number)), 1e-9);
    }
    expect_icc(*answers[set].statistic, want.at(name + "f1"));
    expect_icc(*answers[set].p_value, want.at(name + "p1"), 1e-8);
  }
  EXPECT_LE(100 * of_rounding, answers.size());
}

}  // namespace
}  // namespace seldinger::assessment::statistics
