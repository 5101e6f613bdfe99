// Ranks from 1, the same for equal values: the mean of the places that they take.
#pragma once

#include <span>
#include <vector>

namespace seldinger::assessment::statistics {

std::vector<double> midranks(std::span<const double> values);

// Σ(t³ − t) over groups of t equal values: what ties take from a rank statistic's variance.
double tie_sum(std::span<const double> values);

}  // namespace seldinger::assessment::statistics
