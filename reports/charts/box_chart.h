// Distributions beside each other, panel by panel, each on an axis of its own: boxes of what was drawn or measured,
// and below them what others reported of the same, a centre with its spread.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "assessment/statistics/answer.h"
#include "reports/markup/html.h"

namespace seldinger::reports {

struct BoxRow {
  std::string label;                                       // at the left
  std::string beside;                                      // at the right, in words
  std::optional<std::array<double, 5>> box;                // 5th, 25th, 50th, 75th and 95th percentile
  std::optional<double> centre;                            // of a box a dot, else a square
  std::optional<assessment::statistics::Interval> spread;  // of what was reported
  bool reported = false;                                   // by others, so in another colour
};
struct BoxPanel {
  std::string title;
  std::vector<BoxRow> rows;
  std::optional<double> low, high;  // the ends of a scale that has them
};
struct BoxChart {
  std::string said;  // for who cannot see it
  std::vector<BoxPanel> panels;
  std::vector<std::string> notes;  // below, a line each
};
// A file by itself, with its style. What is not finite is left out; a row of nothing has its words. A panel whose
// values are all above 0 and lie further than a factor of kLogarithmicFrom apart has a logarithmic axis and says
// so. Nothing is drawn of no panel.
constexpr double kLogarithmicFrom = 20.0;
Html box_chart(const BoxChart& chart);

}  // namespace seldinger::reports
