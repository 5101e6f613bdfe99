// The interval of a number that is made of several variances: what it is where each mean square is divided by
// another chi-squared draw, as it could have come out (generalized pivotal quantities: Weerahandi, J. Am. Stat.
// Assoc. 88, 1993).
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>

#include "assessment/statistics/answer.h"

namespace seldinger::assessment::statistics {

struct MeanSquare {
  double value = 0.0, df = 0.0;
};
// `made_of` takes the mean squares' expectations, in their order. The same seed gives the same draws.
Interval pivotal_interval(std::span<const MeanSquare> squares, std::size_t draws, std::uint64_t seed,
                          const std::function<double(std::span<const double>)>& made_of);

inline constexpr std::size_t kPivotalDraws = 2000;

}  // namespace seldinger::assessment::statistics
