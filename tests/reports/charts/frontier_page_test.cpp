#include "reports/charts/frontier_page.h"

#include <gtest/gtest.h>

#include <limits>

namespace seldinger::reports {
namespace {

FrontierPoint point(const char* name, double ms, double error) {
  return {"G1", "exact", name, ms, error, "mean relative", "double"};
}

TEST(FrontierPage, TheFrontierIsWhatNothingBeats) {
  const std::vector<FrontierPoint> points = {point("slow and exact", 90.0, 1e-7), point("dominated", 100.0, 1e-3),
                                             point("fast and coarse", 5.0, 1e-2), point("middle", 20.0, 1e-4),
                                             point("as fast, worse", 20.0, 2e-4)};
  EXPECT_EQ(frontier_of(points), (std::vector<std::size_t>{2, 3, 0}));
  EXPECT_TRUE(frontier_of({}).empty());
}

TEST(FrontierPage, ShowsEveryUsablePointAndEscapes) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::string page = frontier_page("a <b>", {point("one", 1.0, 0.0), point("two & more", 30.0, 1e-5),
                                                   point("lost", nan, 1.0), point("zero", 0.0, 1.0)});
  EXPECT_NE(page.find("a &lt;b&gt;"), std::string::npos);
  EXPECT_NE(page.find("two &amp; more"), std::string::npos);
  EXPECT_EQ(page.find("lost"), std::string::npos);
  EXPECT_EQ(page.find("nan"), std::string::npos);
  std::size_t circles = 0;
  for (std::size_t at = page.find("<circle"); at != std::string::npos; at = page.find("<circle", at + 1)) ++circles;
  EXPECT_EQ(circles, 2U);
}

}  // namespace
}  // namespace seldinger::reports
