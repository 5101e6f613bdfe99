// Bland and Altman's own peak flows, and R on random pairs.
#include "assessment/statistics/reliability/bland_altman.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "tests/assessment/statistics/r_oracle.h"
#include "tests/assessment/statistics/reliability/score_tables.h"

namespace seldinger::assessment::statistics {
namespace {

using fixtures::number_of;

void expect_agreement(double got, double want, double tolerance = 1e-9) {
  fixtures::note_difference(got, want);
  EXPECT_LE(std::abs(got - want), tolerance * std::abs(want)) << got << " for " << want;
}

// Lancet 1986;1:307, table 1: first readings by Wright and by mini meter, l/min.
const fixtures::Rows kPeakFlows = {{494, 512}, {395, 430}, {516, 520}, {434, 428}, {476, 500}, {557, 600},
                                   {413, 364}, {442, 380}, {650, 658}, {433, 445}, {417, 432}, {656, 626},
                                   {267, 260}, {478, 477}, {178, 259}, {423, 350}, {427, 451}};

TEST(BlandAltman, OfThePapersPeakFlows) {
  const Answer answer = bland_altman(fixtures::scores(kPeakFlows), 1.96);
  EXPECT_EQ(answer.n, 17u);
  expect_agreement(*answer.estimate, -2.11764705882, 1e-11);
  expect_agreement(number_of(answer, "sd"), 38.76512987361, 1e-12);
  expect_agreement(number_of(answer, "limit_low"), -78.0973016111, 1e-11);
  expect_agreement(number_of(answer, "limit_high"), 73.8620074935, 1e-11);
  expect_agreement(answer.ci95->low, -22.0488376966, 1e-11);
  expect_agreement(answer.ci95->high, 17.8135435790, 1e-11);
  expect_agreement(number_of(answer, "se_limit"), 16.284611795, 1e-10);
  const Answer wide = bland_altman(fixtures::scores(kPeakFlows), 2.0);
  expect_agreement(number_of(wide, "limit_low"), -79.6479068060, 1e-11);
  expect_agreement(number_of(wide, "limit_high"), 75.4126126884, 1e-11);
  EXPECT_EQ(*bland_altman(complete_table(fixtures::long_table(kPeakFlows)), 1.96).estimate, *answer.estimate);
}

TEST(BlandAltman, SeesDifferencesGrow) {
  const Answer answer =
      bland_altman(fixtures::scores({{1, 1.2}, {2, 2.3}, {3, 3.7}, {4, 4.8}, {5, 6.2}, {6, 7.1}}), 1.96);
  EXPECT_LT(number_of(answer, "slope_p_value"), 0.05);
  EXPECT_FALSE(answer.notes.empty());
}

TEST(BlandAltman, RefusesWithAReason) {
  EXPECT_EQ(bland_altman(fixtures::scores({{1, 2, 3}, {2, 3, 4}}), 1.96).reason, "bad_value");
  EXPECT_EQ(bland_altman(fixtures::scores({{1, 2}}), 1.96).reason, "too_few");
  const Answer constant = bland_altman(fixtures::scores({{1, 2}, {2, 3}, {7, 8}}), 1.96);
  EXPECT_EQ(*constant.estimate, -1.0);
  EXPECT_FALSE(constant.ci95);
}

TEST(BlandAltman, IsThatOfR) {
  SELDINGER_NEEDS_R();
  std::string script;
  std::vector<fixtures::Rows> sets;
  for (std::size_t set = 0; set < fixtures::r_sets(); ++set) {
    sets.push_back(
        fixtures::random_scores(fixtures::r_seed() + 3000 + set, 4 + set, 2, 2.0, 1.0, 0.5, set % 2 == 1));
    std::vector<double> a, b;
    for (const auto& row : sets.back()) a.push_back(row[0]), b.push_back(row[1]);
    const std::string name = "s" + std::to_string(set) + "_";
    script += "a <- " + fixtures::r_vector(a) + "; b <- " + fixtures::r_vector(b) +
              "; d <- a - b; m <- (a + b) / 2\n" + "say('" + name +
              "p', try(t.test(d)$p.value, silent = TRUE)); say('" + name +
              "low', try(t.test(d)$conf.int[1], silent = TRUE)); f <- summary(lm(d ~ m))$coefficients; say('" +
              name + "slope', f[2, 1]); say('" + name + "slope_p', f[2, 4])\n" + "say('" + name +
              "limit', mean(d) + 1.96 * sd(d))\n";
  }
  const std::map<std::string, double> want = fixtures::r_values(script);
  for (std::size_t set = 0; set < sets.size(); ++set) {
    SCOPED_TRACE(set);
    const std::string name = "s" + std::to_string(set) + "_";
    const Answer answer = bland_altman(fixtures::scores(sets[set]), 1.96);
    fixtures::note_difference(answer.ci95->low, want.at(name + "low"));
    fixtures::note_difference(number_of(answer, "limit_high"), want.at(name + "limit"));
    EXPECT_LE(std::abs(*answer.p_value - want.at(name + "p")), 1e-9);
    EXPECT_LE(std::abs(answer.ci95->low - want.at(name + "low")), 1e-9);
    EXPECT_LE(std::abs(number_of(answer, "limit_high") - want.at(name + "limit")), 1e-9);
    EXPECT_LE(std::abs(number_of(answer, "slope_over_mean") - want.at(name + "slope")), 1e-9);
    EXPECT_LE(std::abs(number_of(answer, "slope_p_value") - want.at(name + "slope_p")), 1e-9);
  }
}

}  // namespace
}  // namespace seldinger::assessment::statistics
