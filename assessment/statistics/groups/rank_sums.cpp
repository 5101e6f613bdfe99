#include "assessment/statistics/groups/rank_sums.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <numeric>

#include "sim/base/check.h"

namespace seldinger::assessment::statistics {
namespace {

void make_chances(std::vector<double>& counts) {
  const double all = std::accumulate(counts.begin(), counts.end(), 0.0);
  for (double& count : counts) count /= all;
}

}  // namespace

WholeRanks whole_ranks(std::span<const double> midranks) {
  WholeRanks whole;
  for (const double rank : midranks)
    if (rank != std::floor(rank)) whole.unit = 2;
  for (const double rank : midranks) whole.scores.push_back(static_cast<int>(std::lround(rank * whole.unit)));
  return whole;
}

std::vector<double> chances_of_draws(std::span<const int> scores, std::size_t m) {
  CHECK(m <= scores.size());
  const int total = std::accumulate(scores.begin(), scores.end(), 0);
  const std::size_t fewer = std::min(m, scores.size() - m);
  std::vector<int> descending(scores.begin(), scores.end());
  std::sort(descending.begin(), descending.end(), std::greater<>());
  std::vector<std::size_t> largest = {0};  // sum of j scores
  for (std::size_t j = 0; j < fewer; ++j) largest.push_back(largest[j] + static_cast<std::size_t>(descending[j]));
  const std::size_t width = largest[fewer] + 1;
  // counts[j * width + s]: ways to draw j of the scores seen so far that add up to s. The largest are seen first:
  // with one more, j of them add up to largest[j] at most.
  std::vector<double> counts((fewer + 1) * width, 0.0);
  counts[0] = 1.0;
  for (std::size_t seen = 0; seen < scores.size(); ++seen) {
    const auto score = static_cast<std::size_t>(descending[seen]);
    for (std::size_t j = std::min(seen + 1, fewer); j >= 1; --j) {
      const double* from = &counts[(j - 1) * width];
      double* to = &counts[j * width] + score;
      for (std::size_t s = 0; s <= largest[j - 1]; ++s) to[s] += from[s];
    }
  }
  std::vector<double> chances(counts.end() - static_cast<std::ptrdiff_t>(width), counts.end());
  make_chances(chances);
  if (fewer == m) return chances;
  std::vector<double> of_others(static_cast<std::size_t>(total) + 1, 0.0);
  for (std::size_t s = 0; s < chances.size(); ++s) of_others[static_cast<std::size_t>(total) - s] = chances[s];
  return of_others;
}

std::vector<double> chances_of_signs(std::span<const int> scores) {
  std::vector<double> chances(static_cast<std::size_t>(std::accumulate(scores.begin(), scores.end(), 0)) + 1, 0.0);
  chances[0] = 1.0;
  std::size_t reached = 0;
  for (const int score : scores) {
    const auto by = static_cast<std::size_t>(score);
    for (std::size_t s = reached + 1; s-- > 0;) {
      chances[s] *= 0.5;
      chances[s + by] += chances[s];
    }
    reached += by;
  }
  return chances;
}

ExactTest exact_test(std::span<const double> chances, int observed, int twice_middle) {
  const int off = std::abs(2 * observed - twice_middle);
  int furthest = 0;
  for (int s = 0; s < static_cast<int>(chances.size()); ++s)
    if (chances[static_cast<std::size_t>(s)] > 0.0) furthest = std::max(furthest, std::abs(2 * s - twice_middle));
  ExactTest test{0.0, 0.0, 0.0};
  for (int s = 0; s < static_cast<int>(chances.size()); ++s) {
    const double chance = chances[static_cast<std::size_t>(s)];
    const int here = std::abs(2 * s - twice_middle);
    if (here >= off) test.two_sided += chance;
    if (s >= observed) test.upper += chance;
    if (here >= furthest) test.smallest += chance;
  }
  return test;
}

std::size_t critical_sum(std::span<const double> chances, double tail) {
  double below = 0.0;
  for (std::size_t s = 0; s < chances.size(); ++s) {
    below += chances[s];
    if (!(below < tail)) return s;
  }
  return chances.size();
}

}  // namespace seldinger::assessment::statistics
