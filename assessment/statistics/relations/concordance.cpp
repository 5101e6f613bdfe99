#include "assessment/statistics/relations/concordance.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "sim/base/check.h"

namespace seldinger::assessment::statistics {
namespace {

// Sums over groups of t tied values that the variance of a concordance is made of.
struct TieSums {
  double pairs = 0.0;     // t(t − 1)
  double triples = 0.0;   // t(t − 1)(t − 2)
  double weighted = 0.0;  // t(t − 1)(2t + 5)
};

TieSums tie_sums(std::span<const double> values) {
  std::vector<double> sorted(values.begin(), values.end());
  std::sort(sorted.begin(), sorted.end());
  TieSums sums;
  for (std::size_t from = 0, to = 0; from < sorted.size(); from = to) {
    while (to < sorted.size() && sorted[to] == sorted[from]) ++to;
    const auto t = static_cast<double>(to - from);
    sums.pairs += t * (t - 1.0);
    sums.triples += t * (t - 1.0) * (t - 2.0);
    sums.weighted += t * (t - 1.0) * (2.0 * t + 5.0);
  }
  return sums;
}

int sign_of(double from, double to) {
  return (from < to) - (to < from);
}

}  // namespace

double concordance_score(std::span<const double> a, std::span<const double> b) {
  int score = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) score += sign_of(a[j], a[i]) * sign_of(b[j], b[i]);
  return score;
}

Concordance concordance_of(std::span<const double> a, std::span<const double> b) {
  Concordance found;
  found.score = concordance_score(a, b);
  const auto n = static_cast<double>(a.size());
  const TieSums in_a = tie_sums(a), in_b = tie_sums(b);
  const double pairs = n * (n - 1.0);
  found.tau_b = 2.0 * found.score / std::sqrt((pairs - in_a.pairs) * (pairs - in_b.pairs));
  found.variance =
      (pairs * (2.0 * n + 5.0) - in_a.weighted - in_b.weighted) / 18.0 + in_a.pairs * in_b.pairs / (2.0 * pairs);
  if (n > 2.0) found.variance += in_a.triples * in_b.triples / (9.0 * pairs * (n - 2.0));
  found.tied = in_a.pairs > 0.0 || in_b.pairs > 0.0;
  return found;
}

double untied_concordance_p(std::size_t n, double observed) {
  // The chance of each number of inversions, person by person: the next one makes 0 … size − 1 more.
  std::vector<double> chance{1.0};
  for (std::size_t size = 2; size <= n; ++size) {
    std::vector<double> next(chance.size() + size - 1, 0.0);
    for (std::size_t k = 0; k < chance.size(); ++k)
      for (std::size_t more = 0; more < size; ++more) next[k + more] += chance[k] / static_cast<double>(size);
    chance = std::move(next);
  }
  const double most = static_cast<double>(chance.size() - 1);
  double p = 0.0;
  for (std::size_t k = 0; k < chance.size(); ++k)
    if (std::abs(most - 2.0 * static_cast<double>(k)) >= std::abs(observed)) p += chance[k];
  return std::min(1.0, p);
}

double permutation_p(std::span<const double> a, std::span<const double> b, const OrderScore& score) {
  CHECK(a.size() <= kMostPermuted && a.size() == b.size());
  const double observed = std::abs(score(a, b));
  const double as_extreme = observed - 1e-9 * std::max(1.0, observed);
  std::vector<double> order(b.begin(), b.end());
  std::sort(order.begin(), order.end());
  // Orders that differ only among equal values are one: each stands for as many.
  std::size_t all = 0, extreme = 0;
  do {
    ++all;
    extreme += std::abs(score(a, order)) >= as_extreme;
  } while (std::next_permutation(order.begin(), order.end()));
  return static_cast<double>(extreme) / static_cast<double>(all);
}

}  // namespace seldinger::assessment::statistics
