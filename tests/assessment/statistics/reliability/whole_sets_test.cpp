// Every set of whole numbers with a mean and an SD, against all sets there are.
#include "assessment/statistics/reliability/whole_sets.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

namespace seldinger::assessment::statistics {
namespace {

std::size_t enumerated(int n, int low, int high, double mean, double sd) {
  std::size_t found = 0;
  std::vector<double> chosen;
  const std::function<void(int)> choose = [&](int from) {
    if (static_cast<int>(chosen.size()) == n) {
      double sum = 0.0, squares = 0.0;
      for (const double one : chosen) sum += one;
      for (const double one : chosen) squares += (one - sum / n) * (one - sum / n);
      found +=
          std::abs(sum / n - mean) <= 0.05 + 1e-9 && std::abs(std::sqrt(squares / (n - 1)) - sd) <= 0.05 + 1e-9;
      return;
    }
    for (int value = from; value <= high; ++value) {
      chosen.push_back(value);
      choose(value);
      chosen.pop_back();
    }
  };
  choose(low);
  return found;
}

TEST(WholeSets, AreAllThatThereAre) {
  std::size_t some = 0;
  for (const auto& [n, low, high] : {std::tuple{2, 1, 5}, {5, 1, 5}, {7, -2, 2}, {6, 1, 7}})
    for (int mean = low * 10; mean <= high * 10; mean += 3)
      for (int sd = 0; sd <= 30; ++sd) {
        const ReportedScale reported{.n = static_cast<std::size_t>(n),
                                     .mean = mean / 10.0,
                                     .mean_decimals = 1,
                                     .sd = sd / 10.0,
                                     .sd_decimals = 1,
                                     .low = static_cast<double>(low),
                                     .high = static_cast<double>(high)};
        const WholeSets sets = whole_sets_of(reported);
        const std::size_t expected = enumerated(n, low, high, mean / 10.0, sd / 10.0);
        ASSERT_EQ(sets.count, expected) << n << " " << mean << " " << sd;
        EXPECT_TRUE(sets.all);
        EXPECT_EQ(sets.first.size(), expected > 0 ? reported.n : 0U);
        EXPECT_EQ(expected > 0, sd_is_possible(reported) == Possible::kYes);
        some += expected;
      }
  EXPECT_GT(some, 100U);
}

TEST(WholeSets, NeedNoEndsOfAScale) {
  EXPECT_EQ(whole_sets_of({.n = 3, .mean = 13.5, .sd = 13.48, .items = 2}).count, 2U) << "−2, 20 and 22.5, too";
  const WholeSets sets = whole_sets_of({.n = 3, .mean = 13.5, .sd = 13.48, .items = 2, .low = 0.0});
  EXPECT_EQ(sets.count, 1U);
  EXPECT_EQ(sets.first, (std::vector<std::int64_t>{9, 14, 58})) << "4.5, 7 and 29 in halves";
}

TEST(WholeSets, SayWhereTheyStopCounting) {
  const ReportedScale wide{.n = 19, .mean = 30.42, .sd = 2.59, .low = 18.0, .high = 99.0};
  EXPECT_TRUE(whole_sets_of(wide).all);
  const WholeSets few = whole_sets_of(wide, 10);
  EXPECT_EQ(few.count, 10U);
  EXPECT_FALSE(few.all);
}

}  // namespace
}  // namespace seldinger::assessment::statistics
