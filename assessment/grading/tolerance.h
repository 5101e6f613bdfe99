// Where most of a normal population lies, told from a sample of it: two-sided tolerance intervals.
#pragma once

#include <cstddef>

namespace seldinger::assessment {

// k such that mean ± k sd of `n` values holds `share` of the population, with `confidence`: Howe, J. Am. Stat.
// Assoc. 64 (1969) 610, less than 1 % below the exact factor from n = 8 on. CHECKs n ≥ 2, 0 < share, confidence
// < 1.
double tolerance_factor(std::size_t n, double share, double confidence);

}  // namespace seldinger::assessment
