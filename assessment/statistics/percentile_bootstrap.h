// Persons drawn again with replacement, and where 95 of 100 of what they then give lie: the interval of a number
// that has no formula for one. Its percentiles are further out the fewer persons there are, as t is against z: the
// plain ones are too narrow (Hesterberg, Am. Stat. 69, 2015, "expanded percentile interval").
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "assessment/statistics/answer.h"

namespace seldinger::assessment::statistics {

// The indices of one draw, by group.
using Draw = std::vector<std::vector<std::size_t>>;

struct Bootstrapped {
  std::optional<Interval> ci95;        // nothing where less than nineteen in twenty draws gave a number
  std::size_t draws = 0, without = 0;  // draws that gave none
  std::vector<double> values;          // what the others gave, rising
};
// `statistic` of each draw, NaN where it has none; each group is drawn from by itself. The same seed gives the same
// draws.
Bootstrapped percentile_bootstrap(std::span<const std::size_t> group_sizes, std::size_t draws, std::uint64_t seed,
                                  const std::function<double(const Draw&)>& statistic);

}  // namespace seldinger::assessment::statistics
