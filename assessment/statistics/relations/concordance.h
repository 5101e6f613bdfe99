// Of n persons ranked twice, how many pairs are ranked alike less how many are not, and how probable that is by
// chance.
#pragma once

#include <cstddef>
#include <functional>
#include <span>

namespace seldinger::assessment::statistics {

struct Concordance {
  double score = 0.0;     // pairs alike less pairs not alike
  double tau_b = 0.0;     // NaN where one sample does not vary
  double variance = 0.0;  // of the score when nothing goes together, ties counted
  bool tied = false;
};
// Both in O(n²).
double concordance_score(std::span<const double> a, std::span<const double> b);
Concordance concordance_of(std::span<const double> a, std::span<const double> b);

// P(|score| ≥ |observed|) without ties, over all orders.
double untied_concordance_p(std::size_t n, double observed);

// The share of all orders of b, beside a, in which |score(b)| is not below |score| of the order given (up to
// rounding). For at most kMostPermuted.
inline constexpr std::size_t kMostPermuted = 9;
using OrderScore = std::function<double(std::span<const double>, std::span<const double>)>;
double permutation_p(std::span<const double> a, std::span<const double> b, const OrderScore& score);

}  // namespace seldinger::assessment::statistics
