// Tests of sim/case/record/time_histogram: every length has its bin, and quantiles are those of the sorted lengths.
#include "sim/case/record/time_histogram.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "sim/case/record/servo_record.h"

namespace seldinger::cases {
namespace {

TEST(TimeHistogram, BinsFollowEachOtherWithoutAGap) {
  for (std::size_t bin = 0; bin + 1 < TimeHistogram::kBins; ++bin) {
    const std::uint64_t longest = longest_of_time_bin_ns(bin);
    EXPECT_EQ(time_bin(longest), bin);
    EXPECT_EQ(time_bin(longest + 1), bin + 1);
    if (bin == 0) continue;
    const std::uint64_t shortest = longest_of_time_bin_ns(bin - 1) + 1;
    EXPECT_LE(16 * (longest - shortest), shortest) << "within 1/16";
  }
  EXPECT_GT(longest_of_time_bin_ns(TimeHistogram::kBins - 2), 30'000'000'000U);
  EXPECT_EQ(time_bin(~std::uint64_t{0}), TimeHistogram::kBins - 1);
}

TEST(TimeHistogram, QuantilesAreThoseOfTheSortedLengths) {
  TimeHistogram histogram;
  std::vector<std::uint64_t> lengths;
  std::uint64_t x = 12345;
  for (int i = 0; i < 5000; ++i) {
    x = x * 6364136223846793005U + 1442695040888963407U;
    lengths.push_back((x >> 40U) >> (x >> 60U));  // 0 to 16 million, over many doublings
    histogram.add(lengths.back());
  }
  std::sort(lengths.begin(), lengths.end());
  EXPECT_EQ(histogram.n, lengths.size());
  for (const double share : {0.0, 0.001, 0.25, 0.5, 0.9, 0.999, 1.0}) {
    const auto rank = static_cast<std::size_t>(std::max(1.0, std::ceil(share * 5000.0)));
    const auto exact = static_cast<double>(lengths[rank - 1]);
    const auto told = static_cast<double>(histogram.quantile_ns(share));
    EXPECT_GE(told, exact) << share;
    EXPECT_LE(told, exact * (1.0 + 1.0 / 16.0)) << share;
  }
  EXPECT_EQ(histogram.quantile_ns(1.0), lengths.back());
  EXPECT_EQ(histogram.most_ns, lengths.back());
}

TEST(TimeHistogram, OfNothingAndOfOne) {
  TimeHistogram histogram;
  EXPECT_EQ(histogram.quantile_ns(0.5), 0U);
  histogram.add(1'000'003);
  for (const double share : {0.0, 0.5, 1.0}) EXPECT_EQ(histogram.quantile_ns(share), 1'000'003U);
}

TEST(ServoRecord, TheShareIsOfAllThatWereDue) {
  ServoRecord record;
  EXPECT_EQ(record.missed_share(), 0.0);
  record.ticks = 75;
  record.missed = 25;
  EXPECT_EQ(record.missed_share(), 0.25);
}

}  // namespace
}  // namespace seldinger::cases
