#include "assessment/statistics/percentile_bootstrap.h"

#include <algorithm>
#include <cmath>

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
  found.ci95 = Interval{share_below(values, 0.025), share_below(values, 0.975)};
  return found;
}

}  // namespace seldinger::assessment::statistics
