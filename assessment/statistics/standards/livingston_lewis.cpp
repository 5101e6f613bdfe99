#include "assessment/statistics/standards/livingston_lewis.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "assessment/statistics/distributions.h"

namespace seldinger::assessment::statistics {
namespace {

constexpr int kHalfSteps = 400;  // of Simpson's rule on either side of the cut
constexpr double kMostItems = 100'000.0;

}  // namespace

double effective_length(const BetaScores& of) {
  const double variance = of.sd * of.sd;
  return ((of.mean - of.low) * (of.high - of.mean) - of.reliability * variance) /
         (variance * (1.0 - of.reliability));
}

std::optional<Classification> livingston_lewis_of(const BetaScores& of) {
  const double length = std::round(effective_length(of));
  if (!(length >= 2.0 && length <= kMostItems)) return std::nullopt;
  const double range = of.high - of.low, mean = (of.mean - of.low) / range;
  const double variance = of.reliability * of.sd * of.sd / (range * range);
  const double size = mean * (1.0 - mean) / variance - 1.0;
  if (!(size > 0.0) || !(mean > 0.0 && mean < 1.0)) return std::nullopt;
  const double a = mean * size, b = (1.0 - mean) * size;
  const double cut = std::clamp((of.cut - of.low) / range, 0.0, 1.0);
  const auto items = static_cast<std::int64_t>(length);
  const auto needed = static_cast<std::int64_t>(std::ceil(cut * length - 1e-9));
  const auto passes = [&](double truly) { return 1.0 - binomial_cdf(needed - 1, items, truly); };
  // Over the shares of persons below a true score, in which the density is 1 everywhere.
  const double below = beta_cdf(cut, a, b);
  struct Sums {
    double pass = 0.0, both = 0.0;
  };
  const auto over = [&](double from, double to) {
    Sums sums;
    if (!(to > from)) return sums;
    for (int i = 0; i <= kHalfSteps; ++i) {
      // Places lie closer together towards both ends, where the quantiles are steep.
      const double v = static_cast<double>(i) / kHalfSteps, u = from + (to - from) * v * v * (3.0 - 2.0 * v);
      const double weight = (i == 0 || i == kHalfSteps ? 1.0
                             : i % 2 == 1              ? 4.0
                                                       : 2.0) *
                            6.0 * v * (1.0 - v) * (to - from) / (3.0 * kHalfSteps);
      const double p = passes(beta_quantile(std::clamp(u, 1e-12, 1.0 - 1e-12), a, b));
      sums.pass += weight * p;
      sums.both += weight * (p * p + (1.0 - p) * (1.0 - p));
    }
    return sums;
  };
  const Sums under = over(0.0, below), above = over(below, 1.0);
  Classification found;
  found.pass = under.pass + above.pass;
  found.consistency = under.both + above.both;
  const double by_chance = found.pass * found.pass + (1.0 - found.pass) * (1.0 - found.pass);
  found.kappa = (found.consistency - by_chance) / (1.0 - by_chance);
  found.false_pass = under.pass;
  found.false_fail = (1.0 - below) - above.pass;
  found.accuracy = 1.0 - found.false_pass - found.false_fail;
  return found;
}

}  // namespace seldinger::assessment::statistics
