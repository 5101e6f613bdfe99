#include "assessment/grading/tolerance.h"

#include <cmath>
#include <limits>
#include <numbers>

#include "sim/base/check.h"

namespace seldinger::assessment {
namespace {

constexpr int kHalvings = 200;  // down to neighbouring doubles
constexpr double kFarNormal = 40.0;

double normal_share_below(double x) {
  return 0.5 * std::erfc(-x / std::numbers::sqrt2);
}

// The regularised lower incomplete gamma function P(degrees / 2, x / 2), by its series: DLMF 8.11.4.
double chi_squared_share_below(double x, double degrees) {
  if (!(x > 0.0)) return 0.0;
  const double a = 0.5 * degrees, half = 0.5 * x;
  double term = 1.0, sum = 1.0;
  for (double k = 1.0; term > sum * std::numeric_limits<double>::epsilon(); k += 1.0) {
    term *= half / (a + k);
    sum += term;
  }
  return std::exp(a * std::log(half) - half - std::lgamma(a + 1.0)) * sum;
}

// Where a rising function comes to p.
template <typename Function>
double where(Function rising, double p, double low, double high) {
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = 0.5 * (low + high);
    (rising(middle) < p ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

}  // namespace

double normal_quantile(double p) {
  CHECK(p > 0.0 && p < 1.0);
  return where(&normal_share_below, p, -kFarNormal, kFarNormal);
}

double chi_squared_quantile(double p, double degrees) {
  CHECK(p > 0.0 && p < 1.0 && degrees > 0.0);
  const auto below = [&](double x) { return chi_squared_share_below(x, degrees); };
  double high = degrees;
  while (below(high) < p) high *= 2.0;
  return where(below, p, 0.0, high);
}

double tolerance_factor(std::size_t n, double share, double confidence) {
  CHECK(n >= 2 && share > 0.0 && share < 1.0 && confidence > 0.0 && confidence < 1.0);
  const auto size = static_cast<double>(n);
  const double z = normal_quantile(0.5 * (1.0 + share));
  return z * std::sqrt((size - 1.0) * (1.0 + 1.0 / size) / chi_squared_quantile(1.0 - confidence, size - 1.0));
}

}  // namespace seldinger::assessment
