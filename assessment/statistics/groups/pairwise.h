// Differences of all pairs, and means of all pairs, in order, without writing them down.
#pragma once

#include <cstddef>
#include <span>

namespace seldinger::assessment::statistics {

// The k-th smallest (from 1) of all a − b, and of the means of all pairs of `values`, each with itself too (Walsh
// averages). Values ascend.
double kth_difference(std::span<const double> a, std::span<const double> b, std::size_t k);
double kth_walsh_average(std::span<const double> values, std::size_t k);

}  // namespace seldinger::assessment::statistics
