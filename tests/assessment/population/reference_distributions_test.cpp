// Published distributions: that each row says whose, of how many, in which unit, and is what its source gives.
#include "assessment/population/reference_distributions.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <string>

#include "assessment/population/person.h"
#include "assessment/registry.h"

namespace seldinger::assessment::population {
namespace {

const ReferenceDistribution& distribution_of(std::string_view source, std::string_view metric,
                                             std::string_view group) {
  for (const ReferenceDistribution& row : reference_distributions())
    if (row.source.find(source) != row.source.npos && row.metric == metric &&
        row.group.find(group) != row.group.npos)
      return row;
  throw std::runtime_error("there is no such row");
}

TEST(ReferenceDistributions, SayWhoseOfHowManyAndInWhichUnit) {
  std::set<std::string_view> sources;
  std::size_t with_spread = 0;
  for (const ReferenceDistribution& row : reference_distributions()) {
    const std::string shown = std::string(row.source) + ", " + std::string(row.metric);
    sources.insert(row.source);
    EXPECT_FALSE(row.source.empty()) << shown;
    EXPECT_FALSE(row.group.empty()) << shown;
    EXPECT_FALSE(row.counted.empty()) << shown;
    EXPECT_FALSE(row.how.empty()) << shown;
    EXPECT_GT(row.n, 1U) << shown;
    EXPECT_TRUE(named_group(std::string(row.level)).has_value()) << shown;
    // In the unit of the metric that it lies beside.
    const MetricInfo* info = find_metric(std::string(row.metric));
    ASSERT_NE(info, nullptr) << shown;
    EXPECT_EQ(row.unit, std::string_view(info->unit) == "bool" ? "share" : info->unit) << shown;
    EXPECT_EQ(row.centre == Centre::share, std::string_view(info->unit) == "bool") << shown;
    EXPECT_TRUE(std::isfinite(row.value)) << shown;
    EXPECT_GT(row.value, 0.0) << shown;
    const auto spread = spread_of(row);
    ASSERT_EQ(spread.has_value(), row.spread != Spread::none) << shown;
    if (!spread) continue;
    ++with_spread;
    EXPECT_LT(spread->low, row.value) << shown;
    EXPECT_GT(spread->high, row.value) << shown;
    EXPECT_EQ(row.centre == Centre::mean, row.spread == Spread::standard_deviation) << shown;
  }
  EXPECT_GE(sources.size(), 8U);
  EXPECT_GE(with_spread, 10U);
}

// Figures as the abstracts print them.
TEST(ReferenceDistributions, AreWhatTheirSourcesGive) {
  const auto& control = distribution_of("Keri", "path_in_tissue", "spine model");  // 629.7 [306.4-2,879.1] mm
  EXPECT_NEAR(control.value, 629.7, 1e-9);
  EXPECT_NEAR(spread_of(control)->low, 306.4, 1e-9);
  EXPECT_NEAR(spread_of(control)->high, 2879.1, 1e-9);
  const auto& damage = distribution_of("Keri", "swept_area", "after training");  // 39.7 [21.3-42.7] cm²
  EXPECT_NEAR(damage.value, 3970.0, 1e-9);
  EXPECT_NEAR(spread_of(damage)->low, 2130.0, 1e-9);
  EXPECT_NEAR(spread_of(damage)->high, 4270.0, 1e-9);
  const auto& students = distribution_of("Greiner", "time_total", "cart-based");  // 0.60 min, 0.30-2.09 min
  EXPECT_NEAR(students.value, 36.0, 1e-9);
  EXPECT_NEAR(spread_of(students)->high, 125.4, 1e-9);
  const auto& block = distribution_of("Mokhtar", "time_puncture_to_target", "phantom block");  // 16 ± 8 s
  EXPECT_NEAR(spread_of(block)->low, 8.0, 1e-9);
  EXPECT_NEAR(spread_of(block)->high, 24.0, 1e-9);
  EXPECT_EQ(block.n, 47U);
  const auto& advanced = distribution_of("Hayward", "time_total", "advanced");  // 28.5 s (24-40)
  EXPECT_EQ(advanced.level, "expert");
  EXPECT_NEAR(spread_of(advanced)->high, 40.0, 1e-9);
  // 92.3 s less are 68 %.
  EXPECT_NEAR(0.68 * distribution_of("Fulton", "time_total", "residents").value, 92.3, 1e-9);
  EXPECT_NEAR(distribution_of("PMC5318157", "first_pass_success", "residents").value, 0.764, 5e-4);
  EXPECT_FALSE(spread_of(distribution_of("Xia", "path_inefficiency", "first")).has_value());
}

}  // namespace
}  // namespace seldinger::assessment::population
