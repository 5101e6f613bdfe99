#include "assessment/statistics/percentile_bootstrap.h"

#include <algorithm>
#include <cmath>

#include "assessment/statistics/distributions.h"
#include "sim/base/rng.h"

namespace seldinger::assessment::statistics {
namespace {

// Type 7 of Hyndman and Fan.
double share_below(const std::vector<double>& sorted, double share) {
  const double place = share * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<std::size_t>(place);
  const std::size_t above = std::min(below + 1, sorted.size() - 1);
  return sorted[below] + (place - static_cast<double>(below)) * (sorted[above] - sorted[below]);
}

// What lies below the interval's lower end, for the smallest of the groups that are drawn from.
double tail_of(std::span<const std::size_t> group_sizes) {
  double tail = 0.025;
  for (const std::size_t size : group_sizes) {
    if (size < 2) continue;
    const double n = static_cast<double>(size);
    tail = std::min(tail, normal_cdf(-std::sqrt(n / (n - 1.0)) * student_t_quantile(0.975, n - 1.0)));
  }
  return tail;
}

}  // namespace

Bootstrapped percentile_bootstrap(std::span<const std::size_t> group_sizes, std::size_t draws, std::uint64_t seed,
                                  const std::function<double(const Draw&)>& statistic) {
  base::Rng rng(seed);
  Bootstrapped found;
  found.draws = draws;
  Draw draw;
  for (const std::size_t size : group_sizes) draw.emplace_back(size);
  std::vector<double>& values = found.values;
  for (std::size_t i = 0; i < draws; ++i) {
    for (auto& group : draw)
      for (std::size_t& index : group)
        index =
            std::min(group.size() - 1, static_cast<std::size_t>(rng.uniform() * static_cast<double>(group.size())));
    const double value = statistic(draw);
    if (std::isfinite(value))
      values.push_back(value);
    else
      ++found.without;
  }
  if (values.empty() || values.size() * 20 < draws * 19) return found;
  std::sort(values.begin(), values.end());
  const double tail = tail_of(group_sizes);
  found.ci95 = Interval{share_below(values, tail), share_below(values, 1.0 - tail)};
  return found;
}

}  // namespace seldinger::assessment::statistics
