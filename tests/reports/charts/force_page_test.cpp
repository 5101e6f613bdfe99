#include "reports/charts/force_page.h"

#include <gtest/gtest.h>

#include <limits>

namespace seldinger::reports {
namespace {

int count(const std::string& text, const std::string& what) {
  int n = 0;
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) ++n;
  return n;
}

TEST(ForcePage, DrawsEveryCurveAndEscapes) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::string page =
      force_page("a <b>", {{"kidney",
                            {{"one & only", {{0.0, 0.0}, {10.0, 2.6}, {nan, 1.0}, {20.0, 1.7}}},
                             {"line", {{10.0, 1.63}, {60.0, 2.13}}}}},
                           {"nothing", {{"lost", {{nan, nan}}}}}});
  EXPECT_NE(page.find("a &lt;b&gt;"), std::string::npos);
  EXPECT_NE(page.find("one &amp; only"), std::string::npos);
  EXPECT_EQ(page.find("nan"), std::string::npos);
  EXPECT_EQ(page.find("lost"), std::string::npos);
  EXPECT_EQ(count(page, "<polyline"), 2);
  // The table reads between points, and nothing beside a curve's ends.
  EXPECT_NE(page.find("<tr><td>5</td><td>1.30</td><td></td></tr>"), std::string::npos);
  EXPECT_NE(page.find("<tr><td>35</td><td></td><td>1.88</td></tr>"), std::string::npos);
}

// Axes: 0 to 60 mm and 0 to 3 N over the frame (60 to 840, 354 to 30).
TEST(ForcePage, PutsPointsWhereTheirNumbersSay) {
  const std::string page = force_page("t", {{"c", {{"l", {{0.0, 0.0}, {30.0, 1.5}, {60.0, 3.0}}}}}});
  EXPECT_NE(page.find("points=\"60.0,354.0 450.0,192.0 840.0,30.0 \""), std::string::npos) << page;
}

}  // namespace
}  // namespace seldinger::reports
