// How a whole is divided among classes in order: upright bars, as histograms are drawn.
#pragma once

#include <string>
#include <vector>

#include "reports/markup/html.h"

namespace seldinger::reports {

struct Bar {
  std::string label;   // of the class, short
  double share = 0.0;  // 0 to 1
};

struct BarChart {
  std::string said;  // for who cannot see it
  std::string x_label;
  std::vector<Bar> bars;
};
// Nothing is drawn of no bar; a share that is no number has no height.
Html bar_chart(const BarChart& chart);
// 0.4 % and 12 %, and what is too little for that "under 0.1 %".
std::string share_text(double share);

}  // namespace seldinger::reports
