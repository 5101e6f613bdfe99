// Means with their standard deviations, group beside group on one scale: as papers draw questionnaires.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "reports/markup/html.h"

namespace seldinger::reports {

struct MeanMark {
  double mean = 0.0, sd = 0.0;
};

struct MeanRow {
  std::string label;                           // "8a  US visual elements …"
  std::vector<std::optional<MeanMark>> marks;  // one a series; none: not asked, or not answered
};

struct MeanChart {
  std::string said;  // for who cannot see it
  std::vector<std::string> series;
  double low = 1.0, high = 5.0;  // the ends of the scale; a whole number apart
  std::string low_label, high_label;
  std::vector<MeanRow> rows;
};
// The whiskers are one SD to either side, cut at the ends of the scale.
Html mean_chart(const MeanChart& chart);

}  // namespace seldinger::reports
