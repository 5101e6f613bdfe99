// Force against depth: one self-contained HTML page of charts, one for each tissue, several curves in each.
#pragma once

#include <string>
#include <vector>

#include "reports/markup/html.h"

namespace seldinger::reports {

struct ForcePoint {
  double depth_mm = 0.0, force_n = 0.0;
};

struct ForceCurve {
  std::string name;
  std::vector<ForcePoint> points;  // by rising depth
};

struct ForceChart {
  std::string title;
  std::vector<ForceCurve> curves;  // the first lies at the bottom
};

// Points that are not finite are left out; a chart without two usable points is too.
std::string force_page(const std::string& title, const std::vector<ForceChart>& charts);

}  // namespace seldinger::reports
