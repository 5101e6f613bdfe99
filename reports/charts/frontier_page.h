// Time against error: one self-contained HTML page of log-log charts, one chart for each thing that several methods
// can do. A method is on the frontier when none is both faster and nearer the reference.
#pragma once

#include <string>
#include <vector>

#include "reports/markup/html.h"

namespace seldinger::reports {

struct FrontierPoint {
  std::string chart;   // points of one chart are comparable: same task, same unit of error
  std::string method;  // decides the colour
  std::string name;    // what stands beside the point
  double ms = 0.0, error = 0.0;
  std::string error_unit, reference;
};

// Points that are not finite, or whose time is not above 0, are left out. An error of 0 is drawn at the chart's
// lower edge and told as 0 in the table.
std::string frontier_page(const std::string& title, const std::vector<FrontierPoint>& points);

// Indices of the points on the frontier, fastest first. All must be comparable.
std::vector<std::size_t> frontier_of(const std::vector<FrontierPoint>& points);

}  // namespace seldinger::reports
