#include "assessment/statistics/reliability/pivotal_interval.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "sim/base/rng.h"

namespace seldinger::assessment::statistics {
namespace {

// A chi-squared variable, as twice a gamma one (Marsaglia, Tsang, ACM Trans. Math. Softw. 26, 2000).
double chi_squared_draw(base::Rng& rng, double df) {
  // Of a shape under 1 by one that is 1 larger.
  const double shape = 0.5 * df + (df < 2.0 ? 1.0 : 0.0), d = shape - 1.0 / 3.0, c = 1.0 / std::sqrt(9.0 * d);
  for (;;) {
    const double x = rng.normal(), v = std::pow(1.0 + c * x, 3.0), u = 1.0 - rng.uniform();
    if (v <= 0.0 || std::log(u) >= 0.5 * x * x + d - d * v + d * std::log(v)) continue;
    return 2.0 * d * v * (df < 2.0 ? std::pow(1.0 - rng.uniform(), 2.0 / df) : 1.0);
  }
}

}  // namespace

Interval pivotal_interval(std::span<const MeanSquare> squares, std::size_t draws, std::uint64_t seed,
                          const std::function<double(std::span<const double>)>& made_of) {
  base::Rng rng(seed);
  std::vector<double> values, expectations(squares.size());
  for (std::size_t i = 0; i < draws; ++i) {
    for (std::size_t j = 0; j < squares.size(); ++j)
      expectations[j] = squares[j].value * squares[j].df / chi_squared_draw(rng, squares[j].df);
    const double value = made_of(expectations);
    if (!std::isfinite(value))
      return {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::quiet_NaN()};
    values.push_back(value);
  }
  std::sort(values.begin(), values.end());
  const auto place = [&](double share) { return static_cast<std::size_t>(share * static_cast<double>(draws)); };
  return {values[place(0.025)], values[std::min(draws - 1, place(0.975))]};
}

}  // namespace seldinger::assessment::statistics
