// The attempt that stands for several: no outlier, whatever the metrics' units.
#include "session/attempt/median_attempt.h"

#include <gtest/gtest.h>

#include <optional>

namespace seldinger::session {
namespace {

using MetricColumn = std::vector<std::optional<double>>;

// An attempt with the metrics hit, a, b, c, ….
std::vector<assessment::MetricValue> attempt(std::optional<double> hit, const MetricColumn& others) {
  std::vector<assessment::MetricValue> metrics = {{"hit", 1, hit, "bool", ""}};
  for (std::size_t i = 0; i < others.size(); ++i)
    metrics.push_back({std::string(1, static_cast<char>('a' + i)), 1, others[i], "mm", ""});
  return metrics;
}

TEST(MedianAttempt, OfOneMetricItIsTheMedian) {
  EXPECT_EQ(
      index_of_median({attempt(1, {9}), attempt(1, {1}), attempt(1, {4}), attempt(1, {100}), attempt(1, {3})}), 2U);
  EXPECT_EQ(index_of_median({attempt(1, {7})}), 0U);
}

TEST(MedianAttempt, OfManyItIsNearestTheMiddleOfMost) {
  // The first is median in `a` alone and an outlier in the others; the last is next to the middle everywhere.
  EXPECT_EQ(index_of_median({attempt(1, {3, 90, 900}), attempt(1, {1, 1, 1}), attempt(1, {5, 2, 5}),
                             attempt(1, {2, 4, 2}), attempt(1, {4, 3, 3})}),
            4U);
}

TEST(MedianAttempt, UnitsDoNotCount) {
  const std::vector<std::vector<assessment::MetricValue>> all = {attempt(1, {3, 90}), attempt(1, {1, 10}),
                                                                 attempt(1, {2, 20})};
  auto scaled = all;
  for (auto& one : scaled) one[2].value = *one[2].value * 1e6 - 5.0;
  EXPECT_EQ(index_of_median(all), 2U);
  EXPECT_EQ(index_of_median(scaled), 2U);
}

TEST(MedianAttempt, WhetherItHitsIsAsMostDo) {
  EXPECT_EQ(index_of_median({attempt(0, {3}), attempt(1, {1}), attempt(1, {9})}), 1U) << "of equals the first";
  EXPECT_EQ(index_of_median({attempt(1, {3}), attempt(0, {1}), attempt(0, {9})}), 1U);
}

TEST(MedianAttempt, NoValueRanksBehindAll) {
  EXPECT_EQ(index_of_median({attempt(1, {std::nullopt}), attempt(1, {5}), attempt(1, {1})}), 1U);
  EXPECT_EQ(index_of_median({attempt({}, {2}), attempt({}, {1}), attempt({}, {3})}), 0U);
}

}  // namespace
}  // namespace seldinger::session
