// Procedures against published tables and R 4.2.2's answers about R's own data sets.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "assessment/statistics/groups/brunner_munzel.h"
#include "assessment/statistics/groups/describe.h"
#include "assessment/statistics/groups/effect_sizes.h"
#include "assessment/statistics/groups/mann_whitney.h"
#include "assessment/statistics/groups/multiplicity.h"
#include "assessment/statistics/groups/power.h"
#include "assessment/statistics/groups/rank_tests.h"
#include "assessment/statistics/groups/shapiro_wilk.h"
#include "assessment/statistics/groups/signed_rank.h"
#include "assessment/statistics/groups/t_tests.h"
#include "assessment/statistics/groups/variance_analysis.h"
#include "assessment/statistics/spread.h"
#include "tests/assessment/statistics/groups/tables.h"

namespace seldinger::assessment::statistics {
namespace {

constexpr double kClosed = 1e-9, kNearly = 1e-6;
const double kNA = std::numeric_limits<double>::quiet_NaN();

const std::vector<Group> kSleep = {{"1", {0.7, -1.6, -0.2, -1.2, -0.1, 3.4, 3.7, 0.8, 0.0, 2.0}},
                                   {"2", {1.9, 0.8, 1.1, 0.1, -0.1, 4.4, 5.5, 1.6, 4.6, 3.4}}};
const std::vector<Group> kCars = {{"0",
                                   {21.4, 18.7, 18.1, 14.3, 24.4, 22.8, 19.2, 17.8, 16.4, 17.3, 15.2, 10.4, 10.4,
                                    14.7, 21.5, 15.5, 15.2, 13.3, 19.2}},
                                  {"1", {21, 21, 22.8, 32.4, 30.4, 33.9, 27.3, 26, 30.4, 15.8, 19.7, 15, 21.4}}};
const std::vector<Group> kLikert = {{"A", {5, 4, 4, 3, 5}}, {"B", {2, 3, 3, 1, 2, 4}}};
const std::vector<Group> kPlants = {{"ctrl", {4.17, 5.58, 5.18, 6.11, 4.5, 4.61, 5.17, 4.53, 5.33, 5.14}},
                                    {"trt1", {4.81, 4.17, 4.41, 3.59, 5.87, 3.83, 6.03, 4.89, 4.32, 4.69}},
                                    {"trt2", {6.31, 5.12, 5.54, 5.5, 5.37, 5.29, 4.92, 6.15, 5.8, 5.26}}};
const std::vector<Group> kTeeth = {{"0.5", {4.2,  11.5, 7.3,  5.8, 6.4,  10, 11.2, 11.2, 5.2,  7,
                                            15.2, 21.5, 17.6, 9.7, 14.5, 10, 8.2,  9.4,  16.5, 9.7}},
                                   {"1", {16.5, 16.5, 15.2, 17.3, 22.5, 17.3, 13.6, 14.5, 18.8, 15.5,
                                          19.7, 23.3, 23.6, 26.4, 20,   25.2, 25.8, 21.2, 14.5, 27.3}},
                                   {"2", {23.6, 18.5, 33.9, 25.5, 26.4, 32.5, 26.7, 21.5, 23.3, 29.5,
                                          25.5, 26.4, 22.4, 24.5, 24.8, 30.9, 26.4, 27.3, 29.4, 23}}};
const std::vector<Group> kOzone = {
    {"5", {41, 36, 12, 18, kNA, 28, 23, 19, 8,   kNA, 7,   16, 11, 14,  18, 14,
           34, 6,  30, 11, 1,   11, 4,  32, kNA, kNA, kNA, 23, 45, 115, 37}},
    {"6", {kNA, kNA, kNA, kNA, kNA, kNA, 29,  kNA, 71,  39,  kNA, kNA, 23,  kNA, kNA,
           21,  37,  20,  12,  13,  kNA, kNA, kNA, kNA, kNA, kNA, kNA, kNA, kNA, kNA}},
    {"7", {135, 49, 32, kNA, 64, 40,  77,  97, 97,  85, kNA, 10, 27, kNA, 7, 48,
           35,  61, 79, 63,  16, kNA, kNA, 80, 108, 20, 52,  82, 50, 64,  59}},
    {"8", {39, 9,  16, 78, 35, 66, 122, 89, 110, kNA, kNA, 44, 28,  65, kNA, 22,
           59, 23, 31, 44, 21, 9,  kNA, 45, 168, 73,  kNA, 76, 118, 84, 85}},
    {"9", {96, 78, 73, 91, 47, 32, 20, 23, 21, 24, 44, 21,  28, 9,  13,
           46, 18, 13, 24, 16, 13, 23, 36, 7,  14, 30, kNA, 14, 18, 20}}};

std::vector<double> joined(const std::vector<Group>& groups) {
  std::vector<double> all;
  for (const Group& group : groups) all.insert(all.end(), group.values.begin(), group.values.end());
  return present(all);
}

TEST(Published, Descriptions) {
  const Answer answer = describe(table_of({2, 4, 4, 5, 7, 9, kNA}), {});
  EXPECT_EQ(answer.n, 6u);
  EXPECT_EQ(answer.missing, 1u);
  expect_close(more(answer, "sd"), 2.48327740429, kClosed, "SD");
  expect_close(more(answer, "q1"), 4, kClosed, "first quartile");
  expect_close(more(answer, "median"), 4.5, kClosed, "median");
  expect_close(more(answer, "q3"), 6.5, kClosed, "third quartile");
  expect_close(more(answer, "mad"), 2.2239, kClosed, "MAD");
  EXPECT_EQ(spread_of(std::vector{1e9 + 4, 1e9 + 7, 1e9 + 13, 1e9 + 16}).variance, 30.0);
}

TEST(Published, ShapiroWilk) {
  const auto expect = [](const std::vector<double>& values, double w, double p) {
    const Answer answer = shapiro(table_of(values), {});
    expect_close(answer.statistic, w, kNearly, "W");
    EXPECT_NEAR(answer.p_value.value_or(-1.0) / p, 1.0, kNearly);
  };
  expect(joined(kCars), 0.947564726479, 0.122881358539);
  expect({115, 117, 120, 123, 126, 129, 132, 135, 139, 142, 146, 150, 154, 159, 164}, 0.960357180527,
         0.698605473525);
  expect(joined(kOzone), 0.878665999, 2.78960157e-08);
  expect({1, 2, 4}, 0.964285714286, 0.636886845029);
  expect({148, 154, 158, 160, 161, 162, 166, 170, 182, 195, 236}, 0.788814695, 0.006703814057);
}

TEST(Published, TTests) {
  const Answer answer = welch(table_of(kSleep), {});
  expect_close(answer.statistic, -1.8608134674869, kClosed, "t");
  expect_close(answer.df.at(0), 17.7764735161785, kClosed, "df");
  expect_close(answer.p_value, 0.0793941401874, kClosed, "p");
  expect_close(answer.ci95, {-3.3654832307, 0.2054832307}, kClosed, "interval");
  expect_close(student(table_of(kSleep), {}).p_value, 0.0791867142159, kClosed, "Student's p");
  const Answer pairs = paired(table_of_persons(kSleep), {});
  expect_close(pairs.statistic, -4.06212768338, kClosed, "paired t");
  expect_close(pairs.p_value, 0.00283289019738, kClosed, "paired p");
  const Answer cars = welch(table_of(kCars), {});
  expect_close(cars.statistic, -3.76712314514, kClosed, "t of cars");
  expect_close(cars.df.at(0), 18.33225163840, kClosed, "df of cars");
  expect_close(cars.p_value, 0.00137363833307, kClosed, "p of cars");
}

TEST(Published, MannWhitney) {
  const std::vector<double> x = {19, 22, 16, 29, 24}, y = {20, 11, 17, 12};
  const RankSumTest test = exact_rank_sum(x, y);
  EXPECT_EQ(test.u, 17.0);
  expect_close(test.p_value, 0.111111111111, kClosed, "exact");
  expect_close(normal_rank_sum(x, y, true).p_value, 0.111346886533, kClosed, "with continuity correction");
  expect_close(normal_rank_sum(x, y, false).p_value, 0.0864107329737, kClosed, "without");
  const std::vector<Group> permeability = {{"x", {.80, .83, 1.89, 1.04, 1.45, 1.38, 1.91, 1.64, .73, 1.46}},
                                           {"y", {1.15, .88, .90, .74, 1.21}}};
  const Answer answer = mann_whitney(table_of(permeability), {});
  EXPECT_EQ(answer.statistic, 35.0);
  expect_close(answer.p_value, 0.254412254412, kClosed, "two-sided");
  expect_close(exact_rank_sum(permeability[0].values, permeability[1].values).p_upper, 0.127206127206, kClosed,
               "one-sided");
  expect_close(answer.estimate, 0.305, kClosed, "shift");
  expect_close(answer.ci95, {-0.15, 0.76}, kClosed, "its interval");
  const RankSumTest sleep = exact_rank_sum(kSleep[0].values, kSleep[1].values);
  EXPECT_EQ(sleep.u, 25.5);
  expect_close(sleep.p_value, 0.0658165364048, kClosed, "exact with ties");
  expect_close(normal_rank_sum(kSleep[0].values, kSleep[1].values, true).p_value, 0.0693275754336, kClosed,
               "corrected");
  expect_close(normal_rank_sum(kSleep[0].values, kSleep[1].values, false).p_value, 0.063722250155, kClosed,
               "without");
}

// The same data have four p-values; the exact one given the ties is told, with its name.
TEST(Published, TheFourPValuesOfMannWhitney) {
  const Answer answer = mann_whitney(table_of(kLikert), {});
  EXPECT_EQ(answer.statistic, 27.0);
  expect_close(answer.p_value, 13.0 / 462.0, 1e-12, "exact given the ties");
  EXPECT_NE(answer.method.find("exact given the ties, mid-ranks"), std::string::npos) << answer.method;
  expect_close(more(answer, "cliff_delta"), 0.8, kClosed, "δ");
  expect_close(answer.estimate, 2.0, kClosed, "shift");
  const Answer asymptotic = mann_whitney(table_of(kLikert), with({{"method", "asymptotic"}}));
  EXPECT_NEAR(asymptotic.p_value.value_or(-1.0), 0.031633, 5e-7);
  EXPECT_NE(asymptotic.method.find("continuity correction"), std::string::npos) << asymptotic.method;
  EXPECT_NEAR(normal_rank_sum(kLikert[0].values, kLikert[1].values, false).p_value, 0.024932, 5e-7);
}

TEST(Published, BrunnerMunzelOfSleep) {
  const Superiority found = superiority(kSleep[0].values, kSleep[1].values);
  expect_close(std::abs(found.statistic()), 2.1446717367, kClosed, "statistic");
  std::vector<Group> twice = kSleep;
  for (Group& group : twice) group.values.insert(group.values.end(), group.values.begin(), group.values.end());
  EXPECT_NE(brunner_munzel(table_of(twice), {}).method.find("t approximation"), std::string::npos);
}

TEST(Published, SignedRanksOfDepression) {
  const std::vector<double> x = {1.83, 0.50, 1.62, 2.48, 1.68, 1.88, 1.55, 3.06, 1.30};
  const std::vector<double> y = {0.878, 0.647, 0.598, 2.05, 1.06, 1.29, 1.06, 3.14, 1.29};
  const Answer answer = wilcoxon(table_of_persons({{"x", x}, {"y", y}}), {});
  EXPECT_EQ(answer.statistic, 40.0);
  expect_close(answer.p_value, 0.0390625, kClosed, "two-sided");
  std::vector<double> differences;
  for (std::size_t i = 0; i < x.size(); ++i) differences.push_back(x[i] - y[i]);
  expect_close(exact_signed_rank(differences, false).p_upper, 0.01953125, kClosed, "one-sided");
}

TEST(Published, EffectSizes) {
  const std::vector<double>&a = kCars[0].values, &b = kCars[1].values;
  const auto expect = [](const Effect& effect, double value, Interval interval, const char* what) {
    expect_close(effect.value, value, kClosed, what);
    expect_close(effect.ci95, interval, kNearly, what);
  };
  expect(cohen_d(a, b), -1.4779470958, {-2.26597309872, -0.6705686047}, "d");
  expect(hedges_g(a, b), -1.4406354024, {-2.20876719889, -0.653639683325}, "g");
  expect(glass_delta(a, b), -1.17488604487, {-1.92744568757, -0.391689502294}, "Glass's Δ");
  expect(cliff_delta(a, b), -0.65991902834, {-0.835561602145, -0.361886931946}, "δ");
  expect_close(unpooled_d(a, b).value, -1.41104601052, kClosed, "d by mean variance");
  const std::vector<double>&c = kLikert[0].values, &d = kLikert[1].values;
  expect(cliff_delta(c, d), 0.8, {0.365253311208, 0.948266003665}, "δ of Likert values");
  expect(hedges_g(c, d), 1.61777408945, {0.276950273487, 2.89855932047}, "g of Likert values");
  // A published t has no values: these have it.
  const auto evenly = [](int n, double mean) {
    std::vector<double> values;
    for (int i = 0; i < n; ++i) values.push_back(mean + (i - 0.5 * (n - 1)) * std::sqrt(12.0 / (n * (n + 1.0))));
    return values;  // of variance 1
  };
  const double difference = -2.487 * std::sqrt(1.0 / 14.0 + 1.0 / 26.0);
  expect(cohen_d(evenly(14, difference), evenly(26, 0.0)), -0.8244324721, {-1.494889763, -0.143942954},
         "d of a published t");
}

TEST(Published, SeveralGroups) {
  const Answer ozone = kruskal(table_of(kOzone), {});
  expect_close(ozone.statistic, 29.2665763061, kClosed, "H");
  EXPECT_EQ(ozone.df, std::vector{4.0});
  EXPECT_EQ(ozone.missing, 37u);
  EXPECT_NEAR(ozone.p_value.value_or(-1.0) / 6.90071411855e-06, 1.0, kClosed);
  const Answer mucus = kruskal(
      table_of({{"a", {2.9, 3.0, 2.5, 2.6, 3.2}}, {"b", {3.8, 2.7, 4.0, 2.4}}, {"c", {2.8, 3.4, 3.7, 2.2, 2.0}}}),
      {});
  expect_close(mucus.statistic, 0.771428571429, kClosed, "H of mucociliary efficiency");
  expect_close(mucus.p_value, 0.679964773579, kClosed, "p of mucociliary efficiency");
  expect_close(kruskal(table_of(kTeeth), {}).statistic, 40.6689352650, kClosed, "H of teeth");
  const Answer pairs = dunn(table_of(kTeeth), {});
  expect_close(in_row(pairs, "0.5 – 1", "z"), 3.55491115081, kClosed, "z .5–1");
  expect_close(in_row(pairs, "0.5 – 2", "z"), 6.36261167756, kClosed, "z .5–2");
  expect_close(in_row(pairs, "1 – 2", "z"), 2.80770052675, kClosed, "z 1–2");
  expect_close(in_row(pairs, "0.5 – 1", "p_holm"), 7.56213672e-04, kClosed, "Holm .5–1");
  expect_close(in_row(pairs, "1 – 2", "p_holm"), 0.00498966040, kClosed, "Holm 1–2");
  const Answer months = dunn(table_of(kOzone), {});
  expect_close(in_row(months, "5 – 7", "z"), 4.41947064061, kClosed, "z 5–7");
  EXPECT_NEAR(in_row(months, "5 – 7", "p_holm") / 9.8942961e-05, 1.0, kNearly);
  const FTest plants = one_way(kPlants);
  EXPECT_NEAR(plants.f, 4.84609, 5e-6);
  EXPECT_NEAR(plants.p_value(), 0.01591, 5e-6);
  const Answer welch_plants = welch_anova(table_of(kPlants), {});
  expect_close(welch_plants.statistic, 5.1809724081132, kClosed, "Welch's F");
  expect_close(welch_plants.df.at(1), 17.1284186166, kClosed, "Welch's df");
  expect_close(welch_plants.p_value, 0.0173928214902, kClosed, "Welch's p");
  const Answer spreads = brown_forsythe(table_of(kPlants), {});
  EXPECT_NEAR(spreads.statistic.value_or(-1.0), 1.11919, 5e-6);
  EXPECT_NEAR(spreads.p_value.value_or(-1.0), 0.34123, 5e-6);
}

TEST(Published, Jonckheere) {
  const std::vector<Group> groups = {{"expert", {48, 40, 45, 43, 46, 44}},
                                     {"novice", {40, 35, 38, 43, 44, 41}},
                                     {"inter", {38, 40, 47, 44, 40, 42}}};
  const Answer answer = jonckheere(table_of(groups), with({{"order", "novice:inter:expert"}}));
  EXPECT_EQ(answer.statistic, 79.0);
  EXPECT_EQ(more(answer, "expected"), 54.0);
  expect_close(more(answer, "variance"), 150.286764705882, kClosed, "variance with ties");
  expect_close(more(answer, "z"), 2.039293058845, kClosed, "z");
  expect_close(answer.p_value, 0.020710393993, kClosed, "one-sided p");
}

TEST(Published, FriedmanOfRoundingTimes) {
  const std::vector<Group> times = {
      {"round out", {5.40, 5.85, 5.20, 5.55, 5.90, 5.45, 5.40, 5.45, 5.25, 5.85, 5.25,
                     5.65, 5.60, 5.05, 5.50, 5.45, 5.55, 5.45, 5.50, 5.65, 5.70, 6.30}},
      {"narrow angle", {5.50, 5.70, 5.60, 5.50, 5.85, 5.55, 5.40, 5.50, 5.15, 5.80, 5.20,
                        5.55, 5.35, 5.00, 5.50, 5.55, 5.55, 5.50, 5.45, 5.60, 5.65, 6.30}},
      {"wide angle", {5.55, 5.75, 5.50, 5.40, 5.70, 5.60, 5.35, 5.35, 5.00, 5.70, 5.10,
                      5.45, 5.45, 4.95, 5.40, 5.50, 5.35, 5.55, 5.25, 5.40, 5.55, 6.25}}};
  const Answer answer = friedman(table_of_persons(times), {});
  expect_close(answer.statistic, 11.1428571428571, kClosed, "χ²");
  expect_close(answer.p_value, 0.00380504077551, kClosed, "p");
  const std::vector<Group> items = {{"q1", {4, 5, 3, 4, 5, 2, 4, 5}},
                                    {"q2", {4, 4, 3, 5, 5, 2, 3, 5}},
                                    {"q3", {5, 5, 3, 4, 4, 2, 4, 4}},
                                    {"q4", {3, 5, 2, 4, 5, 3, 4, 5}}};
  const Answer tied = friedman(table_of_persons(items), {});
  expect_close(tied.statistic, 0.411764705882, kClosed, "χ² with ties");
  expect_close(tied.p_value, 0.937801601898, kClosed, "p with ties");
}

TEST(Published, Adjustments) {
  const std::vector<double> p = {.0001, .0004, .0019, .0095, .0201, .0278, .0298, .0344,
                                 .0459, .3240, .4262, .5719, .6528, .7590, 1};
  const std::vector<double> bh = {.0015,          .003,           .0095,         .035625,       .0603,
                                  .0638571428571, .0638571428571, .0645,         .0765,         .486,
                                  .581181818182,  .714875,        .753230769231, .813214285714, 1};
  const std::vector<double> holm = {.0015, .0056, .0247, .114, .2211, .278, .278, .278, .3213, 1, 1, 1, 1, 1, 1};
  for (std::size_t i = 0; i < p.size(); ++i) {
    expect_close(bh_adjusted(p)[i], bh[i], kClosed, "BH");
    expect_close(holm_adjusted(p)[i], holm[i], kClosed, "Holm");
  }
  const std::vector<double> even = {.01, .02, .03, .04, .05}, steps = {.05, .08, .09, .09, .09};
  for (std::size_t i = 0; i < even.size(); ++i) {
    expect_close(bh_adjusted(even)[i], .05, 1e-12, "BH of five");
    expect_close(holm_adjusted(even)[i], steps[i], 1e-12, "Holm of five");
  }
}

TEST(Published, Power) {
  expect_close(t_test_power_right(20, 20, 1, 0.05), .868952801692, kClosed, "power, right side");
  expect_close(t_test_power(20, 20, 1, 0.05), .868953027724586, kClosed, "power, both sides");
  expect_close(t_test_n(1, 0.9, 0.05), 22.0210977, kNearly, "n for .90");
  expect_close(t_test_n(0.8, 0.8, 0.05), 25.5245816, kNearly, "n for d = .8");
  expect_close(t_test_n(0.5, 0.8, 0.05), 63.7656104, kNearly, "n for d = .5");
  expect_close(t_test_power(14, 26, 0.8, 0.05), .652481564639, kClosed, "power of 14 and 26");
  EXPECT_NEAR(t_test_detectable(14, 26, 0.8, 0.05), 0.95, 0.005);
  EXPECT_NEAR(noether_total(0.7, 0.5, 0.8, 0.05), 65.41, 0.005);
  EXPECT_NEAR(noether_total(0.75, 0.5, 0.8, 0.05), 41.86, 0.005);
  expect_close(power({}, with({{"d", "0.8"}, {"power", "0.8"}})).estimate, 25.5245816, kNearly, "as a command");
  expect_close(power({}, with({{"n1", "14"}, {"n2", "26"}, {"d", "0.8"}})).estimate, .652481564639, kClosed,
               "power");
  EXPECT_NEAR(power({}, with({{"p", "0.7"}, {"power", "0.8"}})).estimate.value_or(0.0), 65.41, 0.005);
}

}  // namespace
}  // namespace seldinger::assessment::statistics
