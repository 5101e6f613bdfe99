// Values in order with a curve through them and the lines that they are held against: a learning curve, a CUSUM.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "reports/markup/html.h"

namespace seldinger::reports {

struct SeriesPoint {
  double x = 0.0, y = 0.0;
  bool filled = true;  // hollow: what failed
};

struct SeriesLimit {
  double y = 0.0;
  std::string label;  // short, at the line's right end
};

// Where others lie: drawn behind the values.
struct SeriesBand {
  double low = 0.0, high = 0.0;
  std::string label;  // short, at its right end
};

struct SeriesChart {
  std::string said;  // for who cannot see it
  std::string x_label, y_label;
  std::vector<SeriesPoint> points;  // in order of x
  bool joined = false;              // by a line from point to point
  std::vector<std::pair<double, double>> curve;
  std::vector<SeriesLimit> limits;
  std::optional<double> y_low, y_high;  // the ends of a scale that has them
  bool measured_x = false;              // x is a measure with round numbers below, not the place in a row
  std::optional<SeriesBand> band{};
  double y_shown = 1.0;  // times what is written at the ticks: a share as 100 times a per cent
  bool y_whole = false;  // a count: no ticks between whole numbers
};
// What is not finite is left out. Nothing is drawn of no point.
Html series_chart(const SeriesChart& chart);

}  // namespace seldinger::reports
