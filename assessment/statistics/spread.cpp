#include "assessment/statistics/spread.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace seldinger::assessment::statistics {

Spread spread_of(std::span<const double> values) {
  Spread spread;
  spread.n = values.size();
  if (values.empty()) return spread;
  const double n = static_cast<double>(values.size());
  double sum = 0.0;
  for (const double value : values) sum += value;
  const double first = sum / n;
  double offset = 0.0, squares = 0.0, largest = 0.0;
  for (const double value : values) {
    const double off = value - first;
    offset += off;
    squares += off * off;
    largest = std::max(largest, std::abs(value));
    spread.varies = spread.varies || value != values.front();
  }
  // A constant's mean is that constant, whatever its sum was rounded to.
  spread.mean = spread.varies ? first + offset / n : values.front();
  if (values.size() > 1 && spread.varies)
    spread.variance = std::max(0.0, squares - offset * offset / n) / (n - 1.0);
  const double sd = std::sqrt(spread.variance);
  const bool lost = spread.varies && (spread.variance < std::numeric_limits<double>::min() ||
                                      sd <= 10.0 * std::numeric_limits<double>::epsilon() * largest);
  spread.computable = std::isfinite(spread.mean) && std::isfinite(spread.variance) && !lost;
  return spread;
}

}  // namespace seldinger::assessment::statistics
