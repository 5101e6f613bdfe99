// Mean and variance of a sample, and whether they can be computed at all.
#pragma once

#include <cstddef>
#include <span>

namespace seldinger::assessment::statistics {

struct Spread {
  std::size_t n = 0;
  double mean = 0.0;
  double variance = 0.0;  // of n − 1; 0 for one value
  // Finite; and not squares of values too small, or differences of values too large for what they differ by, which
  // would make a variance of rounding errors.
  bool computable = false;
  bool varies = false;  // not all values are the same
};
// In two passes, the second's error taken off (Chan, Golub, LeVeque, Am. Stat. 37, 1983).
Spread spread_of(std::span<const double> values);

}  // namespace seldinger::assessment::statistics
