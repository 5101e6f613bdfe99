// Boxes beside reported figures: they stand where their values are, on the axis that is said.
#include "reports/charts/box_chart.h"

#include <gmock/gmock.h>

#include <limits>

namespace seldinger::reports {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

BoxChart one_panel(BoxRow row) {
  BoxChart chart;
  chart.said = "said";
  BoxPanel& panel = chart.panels.emplace_back();
  panel.title = "Time, s";
  panel.rows.push_back(std::move(row));
  return chart;
}

double number_after(const std::string& text, const std::string& before) {
  const auto at = text.find(before);
  EXPECT_NE(at, text.npos) << before;
  return std::stod(text.substr(at + before.size()));
}

// On an axis of 0 to 100 between x = 400 and 810.
TEST(BoxChart, ABoxStandsWhereItsPercentilesAre) {
  BoxRow row;
  row.label = "novices";
  row.box = {{0.0, 20.0, 50.0, 60.0, 100.0}};
  row.centre = 55.0;
  const std::string svg = box_chart(one_panel(row)).str();
  EXPECT_NEAR(number_after(svg, "class=\"box\" x=\""), 400.0 + 0.2 * 410.0, 0.06);
  EXPECT_NEAR(number_after(svg, "class=\"median\" x1=\""), 400.0 + 0.5 * 410.0, 0.06);
  EXPECT_NEAR(number_after(svg, "class=\"mean\" cx=\""), 400.0 + 0.55 * 410.0, 0.06);
  EXPECT_NEAR(number_after(svg, "class=\"drawn\" x1=\""), 400.0, 0.06);
  EXPECT_THAT(svg, Not(HasSubstr("logarithmic")));
  EXPECT_THAT(svg, HasSubstr("novices"));
}

TEST(BoxChart, WhatIsFarApartAndAboveZeroHasALogarithmicAxis) {
  BoxRow row;
  row.reported = true;
  row.centre = 100.0;
  row.spread = assessment::statistics::Interval{10.0, 1000.0};
  const std::string svg = box_chart(one_panel(row)).str();
  EXPECT_THAT(svg, HasSubstr("(logarithmic axis)"));
  // Halfway between 10 and 1000, less half of the square.
  EXPECT_NEAR(number_after(svg, "class=\"square said\" x=\""), 400.0 + 0.5 * 410.0 - 3.5, 0.06);
  row.spread->low = 0.0;
  EXPECT_THAT(box_chart(one_panel(row)).str(), Not(HasSubstr("logarithmic")));
}

TEST(BoxChart, NothingIsDrawnOfNothingAndWordsAreEscaped) {
  EXPECT_TRUE(box_chart({}).empty());
  BoxRow row;
  row.label = "none <reported>";
  EXPECT_THAT(box_chart(one_panel(row)).str(), HasSubstr("none &lt;reported&gt;"));
  row.centre = std::numeric_limits<double>::quiet_NaN();
  row.box = {{1.0, 2.0, 3.0, 4.0, std::numeric_limits<double>::infinity()}};
  const std::string svg = box_chart(one_panel(row)).str();
  EXPECT_THAT(svg, Not(HasSubstr("class=\"box\"")));
  EXPECT_THAT(svg, Not(HasSubstr("nan")));
  EXPECT_THAT(svg, Not(HasSubstr("inf")));
}

}  // namespace
}  // namespace seldinger::reports
