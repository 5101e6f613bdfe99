// Estimates with their intervals, one below the other on one axis: cuts by several methods, cases by difficulty.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "assessment/statistics/answer.h"
#include "reports/markup/html.h"

namespace seldinger::reports {

struct IntervalRow {
  std::string label;
  double estimate = 0.0;
  std::optional<assessment::statistics::Interval> interval;
  std::string beside;             // at the right: "n = 24"
  bool marked = false;            // the one that holds
  std::optional<double> truth{};  // of what is simulated
};

struct IntervalChart {
  std::string said;  // for who cannot see it
  std::string x_label;
  std::vector<IntervalRow> rows;
  std::optional<double> low, high;  // the ends of a scale that has them
  bool alone = false;               // a file by itself, not of a page: with its style
};
// What is not finite is left out. Nothing is drawn of no row.
Html interval_chart(const IntervalChart& chart);

}  // namespace seldinger::reports
