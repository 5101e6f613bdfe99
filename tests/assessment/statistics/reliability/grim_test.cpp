// GRIM and GRIMMER against every set of whole numbers that there is.
#include "assessment/statistics/reliability/grim.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <map>
#include <set>
#include <string>
#include <utility>

#include "assessment/statistics/reliability/reliability_procedures.h"
#include "tests/assessment/statistics/reliability/score_tables.h"

namespace seldinger::assessment::statistics {
namespace {

TEST(Grim, KnowsThePapersExamples) {
  // Brown and Heathers: 28 whole numbers cannot have the mean 5.19, and can have 5.18 and 5.21.
  EXPECT_FALSE(mean_is_possible({.n = 28, .mean = 5.19}));
  EXPECT_TRUE(mean_is_possible({.n = 28, .mean = 5.18}));
  EXPECT_TRUE(mean_is_possible({.n = 28, .mean = 5.21}));
  EXPECT_TRUE(mean_is_possible({.n = 28, .mean = 5.19, .items = 3}));
  EXPECT_TRUE(mean_is_possible({.n = 100, .mean = 5.19}));
}

TEST(Grim, HoldsToTheScale) {
  EXPECT_TRUE(mean_is_possible({.n = 10, .mean = 6.0, .mean_decimals = 1}));
  EXPECT_FALSE(mean_is_possible({.n = 10, .mean = 6.0, .mean_decimals = 1, .low = 1.0, .high = 5.0}));
}

TEST(Grim, TellsWhichNCan) {
  const Answer answer = grim({.n = 28, .mean = 5.19});
  EXPECT_EQ(*answer.estimate, 0.0);
  ASSERT_EQ(answer.rows.size(), 11u);
  for (const Row& row : answer.rows) {
    const double n = row.values[0].value;
    bool can = false;
    for (double sum = 0.0; sum <= 10.0 * n; ++sum) can = can || std::abs(sum / n - 5.19) <= 0.005 + 1e-12;
    EXPECT_EQ(row.values[1].value, can ? 1.0 : 0.0) << row.name;
  }
}

// The mean and SD of every multiset of n numbers from low to high, each divided by `items`.
void every_set(int n, int low, int high, double sum, double squares, std::set<std::pair<double, double>>& found) {
  if (n == 0) {
    found.insert({sum, squares});
    return;
  }
  for (int value = low; value <= high; ++value)
    every_set(n - 1, value, high, sum + value, squares + value * value, found);
}

void expect_enumerated(int n, int low, int high, int items) {
  std::set<std::pair<double, double>> sums;
  every_set(n, low * items, high * items, 0.0, 0.0, sums);
  const auto is_there = [&](double mean, double sd) {
    for (const auto& [sum, squares] : sums) {
      const double m = sum / n / items, s = std::sqrt(std::max(0.0, (squares - sum * sum / n) / (n - 1))) / items;
      if (std::abs(m - mean) <= 0.05 + 1e-9 && std::abs(s - sd) <= 0.05 + 1e-9) return true;
    }
    return false;
  };
  for (int mean = low * 10; mean <= high * 10; ++mean)
    for (int sd = 0; sd <= (high - low) * 6; ++sd) {
      const ReportedScale reported{.n = static_cast<std::size_t>(n),
                                   .mean = mean / 10.0,
                                   .mean_decimals = 1,
                                   .sd = sd / 10.0,
                                   .sd_decimals = 1,
                                   .items = static_cast<std::size_t>(items),
                                   .low = static_cast<double>(low),
                                   .high = static_cast<double>(high)};
      ASSERT_EQ(sd_is_possible(reported) == Possible::kYes, is_there(mean / 10.0, sd / 10.0))
          << n << " of " << low << " to " << high << " by " << items << ", mean " << mean / 10.0 << ", SD "
          << sd / 10.0;
    }
}

TEST(Grimmer, IsWhatEnumerationSays) {
  expect_enumerated(2, 1, 5, 1);
  expect_enumerated(3, 1, 7, 1);
  expect_enumerated(6, 1, 5, 1);
  expect_enumerated(5, 0, 3, 1);
  expect_enumerated(4, 1, 3, 3);
  expect_enumerated(4, -2, 2, 1);
}

TEST(Grimmer, NeverRefutesWhatIsThere) {
  // Also where there are too many sets to look through, and with no ends of a scale.
  base::Rng rng(7);
  for (int run = 0; run < 300; ++run) {
    const std::size_t n = 2 + static_cast<std::size_t>(rng.uniform() * (run % 10 == 0 ? 300.0 : 40.0));
    const double widest = run % 10 == 0 ? 60.0 : 6.0;
    double sum = 0.0, squares = 0.0;
    for (std::size_t i = 0; i < n; ++i) {
      const double value = std::floor(rng.uniform() * widest);
      sum += value;
      squares += value * value;
    }
    char mean[32], sd[32];
    const double m = sum / static_cast<double>(n);
    std::snprintf(mean, sizeof mean, "%.2f", m);
    std::snprintf(sd, sizeof sd, "%.2f",
                  std::sqrt(std::max(0.0, (squares - sum * m) / static_cast<double>(n - 1))));
    ReportedScale reported{.n = n, .mean = std::stod(mean), .sd = std::stod(sd)};
    if (run % 2 == 0) reported.low = 0.0, reported.high = widest;
    EXPECT_NE(sd_is_possible(reported), Possible::kNo) << n << " " << mean << " " << sd;
  }
}

Answer run_named(const std::string& name, std::map<std::string, std::string> options) {
  for (const Procedure& one : reliability_procedures())
    if (one.name == name) return one.run({}, ProcedureOptions(std::move(options)));
  ADD_FAILURE() << name;
  return {};
}

TEST(Grim, CountsTheDecimalsAsTyped) {
  EXPECT_EQ(*run_named("grim", {{"n", "3"}, {"mean", "1.30"}}).estimate, 0.0);
  EXPECT_EQ(*run_named("grim", {{"n", "3"}, {"mean", "1.3"}}).estimate, 1.0);
  EXPECT_EQ(*run_named("grim", {{"n", "3"}, {"mean", "1.3"}, {"decimals", "2"}}).estimate, 0.0);
  EXPECT_EQ(run_named("grim", {{"n", "3"}}).reason, "bad_value");
  EXPECT_EQ(run_named("grim", {{"mean", "3"}}).reason, "bad_value");
  EXPECT_EQ(run_named("grimmer", {{"n", "1"}, {"mean", "1"}, {"sd", "0"}}).reason, "too_few");
  EXPECT_EQ(run_named("grimmer", {{"n", "20"}, {"mean", "2.5"}}).reason, "bad_value");
}

}  // namespace
}  // namespace seldinger::assessment::statistics
