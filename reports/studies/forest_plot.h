// One effect with its interval as a drawing, on its own scale.
#pragma once

#include <optional>

#include "assessment/statistics/answer.h"
#include "reports/markup/html.h"

namespace seldinger::reports {

struct ForestRow {
  double estimate = 0.0;
  std::optional<assessment::statistics::Interval> interval;
  double nothing = 0.0;              // where there is no difference
  std::optional<double> worthwhile;  // half the width of the band of differences that are not worth a word
  std::optional<assessment::statistics::Interval> bounds;  // of a scale that has ends
};
Html forest_plot(const ForestRow& row, std::string_view said);

}  // namespace seldinger::reports
