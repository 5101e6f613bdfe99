// A course over time as SVG: depth of the tip with the target's, what the picture showed, forces, and lanes of what
// happened.
#pragma once

#include <span>

#include "reports/charts/course.h"
#include "reports/markup/html.h"

namespace seldinger::reports {

// `moments_s` are numbered from 1 above the chart. Colours are CSS variables of the page (--seen, --unseen-way …).
Html timeline(const Course& course, std::span<const double> moments_s);

// A step of 1, 2 or 5 times a power of ten that cuts `range` into at most `most` pieces.
double tick_step(double range, int most);

}  // namespace seldinger::reports
