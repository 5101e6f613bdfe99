// Shares, correlations, areas and counts against values that were published or that R 4.2.2 gave.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "assessment/statistics/relations/concordance.h"
#include "assessment/statistics/relations/correlation.h"
#include "assessment/statistics/relations/fisher_exact.h"
#include "assessment/statistics/relations/proportions.h"
#include "tests/assessment/statistics/relations/tables_of.h"

namespace seldinger::assessment::statistics {
namespace {

using fixtures::answer_of;
using fixtures::expect_near_relative;
using fixtures::grouped;
using fixtures::named;
using fixtures::or_missing;

constexpr double kDigits = 1e-9;

// The motor cars of 1974 that R calls mtcars.
const std::vector<double> kMilesPerGallon = {21,   21,   22.8, 21.4, 18.7, 18.1, 14.3, 24.4, 22.8, 19.2, 17.8,
                                             16.4, 17.3, 15.2, 10.4, 10.4, 14.7, 32.4, 30.4, 33.9, 21.5, 15.5,
                                             15.2, 13.3, 19.2, 27.3, 26,   30.4, 15.8, 19.7, 15,   21.4};
const std::vector<double> kWeight = {2.62,  2.875, 2.32,  3.215, 3.44,  3.46,  3.57, 3.19,  3.15,  3.44,  3.44,
                                     4.07,  3.73,  3.78,  5.25,  5.424, 5.345, 2.2,  1.615, 1.835, 2.465, 3.52,
                                     3.435, 3.84,  3.845, 1.935, 2.14,  1.513, 3.17, 2.77,  3.57,  2.78};

TEST(Proportions, AreThoseOfRAndClopperAndPearson) {
  const Interval wilson = wilson_interval(14, 16), exact = clopper_pearson_interval(14, 16);
  expect_near_relative(wilson.low, 0.639771727342, kDigits, "Wilson");
  expect_near_relative(wilson.high, 0.965022512257, kDigits, "Wilson");
  expect_near_relative(exact.low, 0.616523763151, kDigits, "Clopper–Pearson");
  expect_near_relative(exact.high, 0.984486396185, kDigits, "Clopper–Pearson");
  expect_near_relative(wilson_interval(0, 10).high, 0.277532799863, kDigits, "Wilson of none");
  expect_near_relative(clopper_pearson_interval(0, 10).high, 0.308497107819, kDigits, "exact of none");
  EXPECT_EQ(wilson_interval(0, 10).low, 0.0);
  EXPECT_EQ(wilson_interval(10, 10).high, 1.0);
}

// Newcombe, Stat. Med. 17 (1998) 873, table II, method 10, to its four digits.
TEST(Proportions, DifferAsInNewcombesTable) {
  struct Line {
    std::int64_t k1, n1, k2, n2;
    double low, high;
  };
  for (const Line& line :
       {Line{56, 70, 48, 80, 0.0524, 0.3339}, Line{9, 10, 3, 10, 0.1705, 0.8090}, Line{6, 7, 2, 7, 0.0582, 0.8062},
        Line{5, 56, 0, 29, -0.0381, 0.1926}, Line{0, 10, 0, 20, -0.1611, 0.2775},
        Line{0, 10, 0, 10, -0.2775, 0.2775}, Line{10, 10, 0, 20, 0.6791, 1.0}, Line{10, 10, 0, 10, 0.6075, 1.0}}) {
    const Interval got = newcombe_interval(line.k1, line.n1, line.k2, line.n2);
    EXPECT_NEAR(got.low, line.low, 5.1e-5) << line.k1;
    EXPECT_NEAR(got.high, line.high, 5.1e-5) << line.k1;
  }
}

TEST(Fisher, TastesTea) {
  const Answer tea = answer_of("fisher", grouped({{1, 1, 1, 0}, {1, 0, 0, 0}}));
  expect_near_relative(or_missing(tea.p_value), 0.485714285714, kDigits, "p");
  EXPECT_EQ(tea.n, 8U);
}

TEST(Fisher, SaysWhereTheOddsHaveNoBound) {
  const Answer all = answer_of("fisher", grouped({{1, 1, 1, 1}, {0, 0, 0, 0}}));
  EXPECT_FALSE(all.estimate || all.ci95);
  EXPECT_GT(named(all, "odds_ratio_low"), 1.0);
  expect_near_relative(or_missing(all.p_value), 2.0 / 70.0, kDigits, "p");
  EXPECT_EQ(fisher_exact_of({3, 3, 4, 4}).p_value, 1.0);
  EXPECT_FALSE(fisher_exact_of({3, 3, 4, 4}).odds_ratio);
}

TEST(Correlations, OfMotorCarsAreThoseOfR) {
  const DataTable cars = fixtures::related(kMilesPerGallon, kWeight);
  const Answer pearson = answer_of("pearson", cars);
  expect_near_relative(or_missing(pearson.estimate), -0.867659376517, kDigits, "r");
  expect_near_relative(fixtures::low_of(pearson), -0.933826413, 1e-8, "low");
  expect_near_relative(fixtures::high_of(pearson), -0.744087196, 1e-8, "high");
  expect_near_relative(or_missing(answer_of("spearman", cars).estimate), -0.88642203327, kDigits, "rho");
  expect_near_relative(rank_correlation(kMilesPerGallon, kWeight), -0.88642203327, kDigits, "rho of two samples");
  EXPECT_TRUE(std::isnan(rank_correlation(kWeight, std::vector<double>(kWeight.size(), 1.0))));
  expect_near_relative(or_missing(answer_of("kendall", cars).estimate), -0.727832149528, kDigits, "tau");
}

TEST(Correlations, AreCorrectedForAttenuation) {
  const DataTable cars = fixtures::related(kMilesPerGallon, kWeight);
  const Answer got = answer_of("pearson", cars, {{"reliability_x", "0.81"}, {"reliability_y", "0.64"}});
  expect_near_relative(named(got, "corrected_for_attenuation"), *got.estimate / 0.72, kDigits, "corrected");
  expect_near_relative(named(got, "corrected_low"), got.ci95->low / 0.72, kDigits, "low");
  EXPECT_EQ(got.notes.size(), 2U) << "beyond −1: said";
  EXPECT_EQ(answer_of("pearson", cars, {{"reliability_x", "1.5"}}).reason, "bad_value");
  EXPECT_EQ(answer_of("pearson", cars, {{"reliability_x", "none"}}).reason, "bad_value");
}

TEST(Correlations, OfAStraightLineHaveNoInterval) {
  const Answer line = answer_of("pearson", fixtures::related({1, 2, 3, 4}, {2, 4, 6, 8}));
  EXPECT_EQ(or_missing(line.estimate), 1.0);
  EXPECT_FALSE(line.ci95 || line.p_value);
  EXPECT_FALSE(line.notes.empty());
}

// With ties there is no table: every one of the 8! orders is scored, each person a different one.
TEST(Correlations, AreExactWithTies) {
  const std::vector<double> a = {1, 2, 2, 3, 4, 4, 4, 5}, b = {2, 1, 3, 3, 3, 5, 4, 4};
  std::vector<std::size_t> order = {0, 1, 2, 3, 4, 5, 6, 7};
  const double observed = std::abs(concordance_score(a, b));
  std::size_t extreme = 0, all = 0;
  do {
    std::vector<double> other;
    for (const std::size_t i : order) other.push_back(b[i]);
    extreme += std::abs(concordance_score(a, other)) >= observed;
    ++all;
  } while (std::next_permutation(order.begin(), order.end()));
  const Answer got = answer_of("kendall", fixtures::related(a, b));
  expect_near_relative(or_missing(got.p_value), static_cast<double>(extreme) / static_cast<double>(all), kDigits,
                       "p");
}

TEST(Areas, OfASmallTiedSetAreThoseOfPRoc) {
  const Answer got = answer_of("auc", grouped({{5, 4, 4, 3, 5}, {2, 3, 3, 1, 2, 4}}), {{"positive", "a"}});
  expect_near_relative(or_missing(got.estimate), 0.9, kDigits, "area");
  expect_near_relative(named(got, "delong_se"), std::sqrt(0.00775), kDigits, "se");
  expect_near_relative(named(got, "delong_low"), 0.727456365344, kDigits, "low");
  EXPECT_EQ(named(got, "delong_high"), 1.0);
  // Published with 1.96 for the normal's 97.5 % point.
  const double half = 1.96 * named(got, "delong_se") / 0.09;
  expect_near_relative(1.0 / (1.0 + std::exp(half - std::log(9.0))), 0.569555504, kDigits, "logit low");
  expect_near_relative(1.0 / (1.0 + std::exp(-half - std::log(9.0))), 0.983927007, kDigits, "logit high");
  expect_near_relative(fixtures::low_of(got), 0.569555504, 2e-5, "low");
  expect_near_relative(fixtures::high_of(got), 0.983927007, 1e-6, "high");
}

TEST(Areas, OfGroupsThatDoNotOverlapHaveAWidth) {
  for (const char* positive : {"a", "b"}) {
    const Answer got = answer_of("auc", grouped({{1, 2, 3, 4}, {5, 6, 7}}), {{"positive", positive}});
    ASSERT_TRUE(got.ci95);
    EXPECT_GT(got.ci95->high - got.ci95->low, 0.2);
    EXPECT_LT(got.ci95->high - got.ci95->low, 0.8);
    EXPECT_FALSE(got.notes.empty());
  }
}

TEST(Counts, NeedTwoGroupsAndWholeNumbers) {
  EXPECT_EQ(answer_of("poisson", grouped({{1, 2}, {1.5}})).reason, "bad_value");
  EXPECT_EQ(answer_of("poisson", grouped({{1, 2}, {1}, {3}})).reason, "not_two_groups");
  EXPECT_EQ(answer_of("poisson", grouped({{0, 0}, {0}})).reason, "no_event");
  EXPECT_EQ(answer_of("poisson", grouped({{1, 2}, {1}}, {1, 0, 1})).reason, "bad_value");
  EXPECT_EQ(answer_of("negative_binomial", grouped({{1, 2}, {0, 0}})).reason, "perfect_separation");
  const Answer none = answer_of("poisson", grouped({{4, 7}, {0, 0}}));
  EXPECT_FALSE(none.estimate || none.ci95);
  EXPECT_GT(named(none, "rate_ratio_low"), 1.0);
}

TEST(Persons, StandOnceInEach) {
  DataTable table = grouped({{1, 0}, {1, 0}});
  table.subject = {"p", "q", "r", "r"};
  EXPECT_EQ(answer_of("fisher", table).reason, "repeated_subject");
  table.subject = {"p", "q", "q", "r"};
  EXPECT_EQ(answer_of("fisher", table).reason, "subject_in_two_groups");
  EXPECT_EQ(answer_of("kaplan_meier", table).reason, "subject_in_two_groups");
}

}  // namespace
}  // namespace seldinger::assessment::statistics
