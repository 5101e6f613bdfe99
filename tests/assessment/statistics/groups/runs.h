// Many runs of fixed seeds: how often something happens.
#pragma once

#include <cmath>
#include <cstdint>
#include <functional>
#include <vector>

#include "sim/base/rng.h"

namespace seldinger::assessment::statistics {

inline constexpr int kRuns = 20'000;

inline double standard_error(double share) {
  return std::sqrt(share * (1.0 - share) / kRuns);
}

inline double share_of_runs(const std::function<bool(base::Rng&)>& happens, std::uint64_t seed) {
  int count = 0;
  base::Rng rng(seed);
  for (int run = 0; run < kRuns; ++run) count += happens(rng) ? 1 : 0;
  return static_cast<double>(count) / kRuns;
}

inline std::vector<double> normal_sample(base::Rng& rng, std::size_t n, double mean, double sd) {
  std::vector<double> values;
  for (std::size_t i = 0; i < n; ++i) values.push_back(mean + sd * rng.normal());
  return values;
}

}  // namespace seldinger::assessment::statistics
