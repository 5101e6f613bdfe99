// Axes of round numbers, and charts that nothing odd leaves.
#include "reports/charts/series_chart.h"

#include <gmock/gmock.h>

#include <cmath>

#include "reports/charts/interval_chart.h"
#include "reports/charts/svg_parts.h"
#include "sim/base/rng.h"

namespace seldinger::reports {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

TEST(RoundTicks, HoldTheValuesInFewRoundSteps) {
  EXPECT_THAT(round_ticks(0.0, 1.0),
              ElementsAre(0.0, 0.2, ::testing::DoubleEq(0.4), ::testing::DoubleEq(0.6), 0.8, 1.0));
  base::Rng rng(3);
  for (int i = 0; i < 20'000; ++i) {
    const double low = rng.normal() * std::pow(10.0, 12.0 * rng.uniform() - 6.0);
    const double high = low + std::pow(10.0, 12.0 * rng.uniform() - 6.0) * rng.uniform();
    const auto ticks = round_ticks(low, high);
    ASSERT_GE(ticks.size(), 2U) << low << ' ' << high;
    ASSERT_LE(ticks.size(), 10U) << low << ' ' << high;
    const double step = ticks[1] - ticks[0];
    EXPECT_LE(ticks.front(), low + 1e-6 * step);
    EXPECT_GE(ticks.back(), high - 1e-6 * step);
  }
}

TEST(RoundTicks, OfCountsAreWhole) {
  EXPECT_THAT(round_ticks(1.0, 1.0, 1.0), ElementsAre(0.0, 1.0, 2.0));
  EXPECT_THAT(round_ticks(0.0, 3.0, 1.0), ElementsAre(0.0, 1.0, 2.0, 3.0));
  EXPECT_THAT(round_ticks(0.0, 30.0, 1.0), ElementsAre(0.0, 5.0, 10.0, 15.0, 20.0, 25.0, 30.0));
}

TEST(SeriesChart, TicksAreWrittenInTheUnitThatIsShown) {
  SeriesChart chart;
  chart.points = {{1.0, 0.2}, {2.0, 0.8}};
  chart.y_label = "%";
  chart.y_shown = 100.0;
  chart.y_low = 0.0;
  chart.y_high = 1.0;
  const std::string svg = series_chart(chart).str();
  EXPECT_THAT(svg, HasSubstr(">80</text>"));
  EXPECT_THAT(svg, Not(HasSubstr(">0.8</text>")));
}

TEST(SeriesChart, LeavesOutWhatIsNoNumber) {
  SeriesChart chart{"said <x>",
                    "attempt",
                    "mm",
                    {{1.0, 2.0}, {2.0, std::nan("")}, {3.0, 4.0, false}},
                    true,
                    {{1.0, INFINITY}},
                    {{3.0, "limit"}},
                    {},
                    {}};
  const std::string svg = series_chart(chart).str();
  EXPECT_THAT(svg, HasSubstr("said &lt;x&gt;"));
  EXPECT_THAT(svg, HasSubstr("point hollow"));
  EXPECT_THAT(svg, Not(HasSubstr("nan")));
  EXPECT_THAT(svg, Not(HasSubstr("inf")));
  EXPECT_TRUE(series_chart({}).empty());
}

// A band reaches from its low to its high end on the values' own axis, and one that is no number is not drawn.
TEST(SeriesChart, ABandLiesWhereItsValuesWould) {
  SeriesChart chart;
  chart.said = "said";
  chart.points = {{1.0, 0.0}, {2.0, 10.0}, {3.0, 20.0}};
  chart.band = SeriesBand{0.0, 10.0, "9 consultants"};
  const std::string svg = series_chart(chart).str();
  EXPECT_THAT(svg, HasSubstr("9 consultants"));
  const auto number_behind = [&](const std::string& what, std::size_t from) {
    return std::stod(svg.substr(svg.find(what, from) + what.size()));
  };
  const std::size_t band = svg.find("class=\"band\""), points = svg.find("class=\"point\"");
  ASSERT_NE(band, svg.npos);
  const double low_px = number_behind("cy=\"", points);
  const double high_px = number_behind("cy=\"", svg.find("class=\"point\"", points + 1));
  EXPECT_DOUBLE_EQ(number_behind(" y=\"", band), high_px);
  EXPECT_NEAR(number_behind("height=\"", band), low_px - high_px, 0.11);
  chart.band->high = std::nan("");
  EXPECT_THAT(series_chart(chart).str(), Not(HasSubstr("class=\"band\"")));
}

TEST(IntervalChart, DrawsEstimatesOnOneAxis) {
  IntervalChart chart{"said",
                      "mm",
                      {{"a", 1.0, assessment::statistics::Interval{0.5, 2.0}, "n = 3", true, 1.2},
                       {"b", std::nan(""), {}, "", false, {}}},
                      {},
                      {}};
  const std::string svg = interval_chart(chart).str();
  EXPECT_THAT(svg, HasSubstr("estimate marked"));
  EXPECT_THAT(svg, HasSubstr("truth"));
  EXPECT_THAT(svg, Not(HasSubstr("nan")));
  EXPECT_THAT(svg, Not(HasSubstr(">b<")));
  EXPECT_THAT(svg, Not(HasSubstr("<style>")));
  EXPECT_TRUE(interval_chart({}).empty());
  chart.alone = true;
  const std::string file = interval_chart(chart).str();
  EXPECT_THAT(file, HasSubstr("xmlns=\"http://www.w3.org/2000/svg\""));
  EXPECT_THAT(file, HasSubstr("<style>"));
}

}  // namespace
}  // namespace seldinger::reports
