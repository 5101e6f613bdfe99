// Every metric has a smallest worthwhile difference, and each says where it is from.
#include "assessment/grading/worthwhile.h"

#include <gtest/gtest.h>

#include <set>

#include "assessment/registry.h"

namespace seldinger::assessment {
namespace {

TEST(WorthwhileTest, EveryMetricHasOneWithItsSource) {
  for (const MetricInfo& info : registry()) {
    const Worthwhile& row = worthwhile(info);
    EXPECT_GT(row.difference, 0.0) << info.id;
    EXPECT_FALSE(row.source.empty()) << info.id;
  }
}

TEST(WorthwhileTest, NoRowIsForNothing) {
  std::set<std::string_view> used, seen;
  for (const MetricInfo& info : registry()) used.insert({info.id, info.unit});
  for (const Worthwhile& row : worthwhile_differences()) {
    EXPECT_TRUE(used.contains(row.what)) << row.what;
    EXPECT_TRUE(seen.insert(row.what).second) << row.what << " is there twice";
  }
}

TEST(WorthwhileTest, AMetricsOwnRowGoesBeforeItsUnits) {
  EXPECT_EQ(worthwhile(*find_metric("clearance_min")).what, "clearance_min");
  EXPECT_EQ(worthwhile(*find_metric("blind_advance")).what, "mm");
}

}  // namespace
}  // namespace seldinger::assessment
