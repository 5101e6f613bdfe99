#include "assessment/grading/tolerance.h"

#include <cmath>

#include "assessment/statistics/distributions.h"
#include "sim/base/check.h"

namespace seldinger::assessment {

double tolerance_factor(std::size_t n, double share, double confidence) {
  CHECK(n >= 2 && share > 0.0 && share < 1.0 && confidence > 0.0 && confidence < 1.0);
  const auto size = static_cast<double>(n);
  const double z = statistics::normal_quantile_of(0.5 * (1.0 + share));
  const double chi_squared = statistics::chi_squared_quantile_of(1.0 - confidence, size - 1.0);
  return z * std::sqrt((size - 1.0) * (1.0 + 1.0 / size) / chi_squared);
}

}  // namespace seldinger::assessment
