// Where a function of one variable is zero, between two bounds: by bisection down to neighbouring doubles, slow and
// sure.
#pragma once

#include <cmath>
#include <limits>

namespace seldinger::assessment::statistics {

// NaN where `function` has the same sign, or is no number, at both ends. A bound may be met itself.
template <typename Function>
double root_between(double low, double high, const Function& function) {
  const double at_low = function(low), at_high = function(high);
  if (at_low == 0.0) return low;
  if (at_high == 0.0) return high;
  if (!(at_low < 0.0 && at_high > 0.0) && !(at_low > 0.0 && at_high < 0.0))
    return std::numeric_limits<double>::quiet_NaN();
  const bool rising = at_low < 0.0;
  for (;;) {
    const double middle = low + 0.5 * (high - low);
    if (!(low < middle && middle < high)) return middle;
    const double value = function(middle);
    if (std::isnan(value)) return value;
    if (value == 0.0) return middle;
    ((value < 0.0) == rising ? low : high) = middle;
  }
}

}  // namespace seldinger::assessment::statistics
