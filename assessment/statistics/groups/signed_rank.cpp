#include "assessment/statistics/groups/signed_rank.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <utility>

#include "assessment/statistics/distributions.h"
#include "assessment/statistics/groups/pairwise.h"
#include "assessment/statistics/groups/power.h"
#include "assessment/statistics/groups/rank_sums.h"
#include "assessment/statistics/groups/samples.h"
#include "assessment/statistics/ranks.h"

namespace seldinger::assessment::statistics {
namespace {

// Ranks of sizes with the sign of the differences; zeros have none.
struct SignedRanks {
  std::vector<double> ranks;
  std::vector<bool> positive;
  double ties = 0.0;
  std::size_t zeros = 0;
};

SignedRanks signed_ranks(std::span<const double> differences, bool pratt) {
  SignedRanks result;
  std::vector<double> sizes, kept;
  for (const double difference : differences) {
    if (difference == 0.0) ++result.zeros;
    if (difference != 0.0 || pratt) sizes.push_back(std::abs(difference));
  }
  const std::vector<double> ranks = midranks(sizes);
  std::size_t i = 0;
  for (const double difference : differences) {
    if (difference != 0.0) {
      result.ranks.push_back(ranks[i]);
      result.positive.push_back(difference > 0.0);
      kept.push_back(std::abs(difference));
    }
    if (difference != 0.0 || pratt) ++i;
  }
  result.ties = tie_sum(kept);
  return result;
}

SignedRankTest started(const SignedRanks& signs) {
  SignedRankTest test;
  test.zeros = signs.zeros;
  for (std::size_t i = 0; i < signs.ranks.size(); ++i)
    if (signs.positive[i]) test.v += signs.ranks[i];
  if (signs.ranks.empty()) test.reason = "no_difference";
  return test;
}

// Differences that only rounding tells apart are the same: they are taken to multiples of eight of the largest
// value's last bits.
std::vector<double> without_rounding(const Pairs& pairs) {
  double largest = 0.0;
  for (const std::vector<double>& pair : pairs.blocks.values)
    largest = std::max({largest, std::abs(pair[0]), std::abs(pair[1])});
  if (largest == 0.0 || !std::isfinite(largest)) return pairs.differences;
  const int exponent = std::ilogb(largest) - 49;
  std::vector<double> differences;
  for (const double difference : pairs.differences)
    differences.push_back(std::ldexp(std::nearbyint(std::ldexp(difference, -exponent)), exponent));
  return differences;
}

std::size_t critical_average(std::size_t n) {
  const double count = static_cast<double>(n), all = count * (count + 1.0);
  if (n > kMostExact) {
    const double sd = std::sqrt(all * (2.0 * count + 1.0) / 24.0);
    return static_cast<std::size_t>(std::max(0.0, std::floor(0.25 * all - normal_quantile_of(0.975) * sd)));
  }
  std::vector<int> ranks(n);
  std::iota(ranks.begin(), ranks.end(), 1);
  return critical_sum(chances_of_signs(ranks), 0.025);
}

std::string zeros_said(std::size_t zeros, bool pratt) {
  return std::to_string(zeros) + (zeros == 1 ? " pair does" : " pairs do") + " not differ: left out " +
         (pratt ? "after ranks were given (Pratt)."
                : "before ranks were given (Wilcoxon); zeros=pratt ranks them.");
}

}  // namespace

SignedRankTest exact_signed_rank(std::span<const double> differences, bool pratt) {
  const SignedRanks signs = signed_ranks(differences, pratt);
  SignedRankTest test = started(signs);
  if (test.reason != nullptr) return test;
  const WholeRanks whole = whole_ranks(signs.ranks);
  const int all = std::accumulate(whole.scores.begin(), whole.scores.end(), 0);
  const ExactTest exact =
      exact_test(chances_of_signs(whole.scores), static_cast<int>(std::lround(test.v * whole.unit)), all);
  test.p_value = std::min(1.0, exact.two_sided);
  test.p_upper = std::min(1.0, exact.upper);
  test.smallest = exact.smallest;
  return test;
}

SignedRankTest normal_signed_rank(std::span<const double> differences, bool pratt) {
  const SignedRanks signs = signed_ranks(differences, pratt);
  SignedRankTest test = started(signs);
  if (test.reason != nullptr) return test;
  double all = 0.0, squares = 0.0;
  for (const double rank : signs.ranks) {
    all += rank;
    squares += rank * rank;
  }
  const double off = test.v - 0.5 * all, sd = 0.5 * std::sqrt(squares);
  test.p_value = two_sided_normal(std::max(0.0, std::abs(off) - 0.5) / sd);
  test.p_upper = normal_upper((off - 0.5) / sd);
  return test;
}

Shift pseudo_median(std::span<const double> differences) {
  std::vector<double> sorted(differences.begin(), differences.end());
  std::sort(sorted.begin(), sorted.end());
  const std::size_t n = sorted.size(), averages = n * (n + 1) / 2;
  Shift shift{
      0.5 * kth_walsh_average(sorted, (averages + 1) / 2) + 0.5 * kth_walsh_average(sorted, averages / 2 + 1),
      std::nullopt};
  if (const std::size_t k = critical_average(n); k > 0)
    shift.ci95 = Interval{kth_walsh_average(sorted, k), kth_walsh_average(sorted, averages + 1 - k)};
  return shift;
}

Answer wilcoxon(const DataTable& table, const ProcedureOptions& options) {
  const std::string zeros = options.text("zeros", "drop");
  if (zeros != "drop" && zeros != "pratt") return bad_option("wilcoxon", "zeros is drop or pratt.");
  const bool pratt = zeros == "pratt";
  Pairs pairs = complete_pairs(table, options, 1);
  if (pairs.blocks.reason != nullptr) return pairs.blocks.refused("wilcoxon");
  const std::vector<double> differences = without_rounding(pairs);
  const bool exact = differences.size() <= kMostExact;
  const SignedRankTest test =
      exact ? exact_signed_rank(differences, pratt) : normal_signed_rank(differences, pratt);
  pairs.blocks.reason = test.reason;
  for (const double difference : differences)
    if (!std::isfinite(difference)) pairs.blocks.reason = "no_finite_answer";
  if (pairs.blocks.reason != nullptr) return pairs.blocks.refused("wilcoxon");
  const bool ties = signed_ranks(differences, pratt).ties > 0.0;
  Answer answer = pairs.blocks.answer(
      "wilcoxon", std::string("Wilcoxon's signed-rank test, two-sided, ") +
                      (exact ? "exact" : "asymptotic, continuity correction") +
                      (ties ? exact ? " given the ties, mid-ranks" : ", variance corrected for ties" : ""));
  const Shift shift = pseudo_median(pairs.differences);
  answer.statistic = test.v;
  answer.p_value = test.p_value;
  answer.estimate = shift.estimate;
  answer.estimate_name = "Hodges–Lehmann middle of differences (" + pairs.blocks.conditions[0] + " − " +
                         pairs.blocks.conditions[1] + ")";
  answer.ci95 = shift.ci95;
  const double n = static_cast<double>(differences.size() - test.zeros);
  answer.more = {{"zeros", static_cast<double>(test.zeros)}};
  if (test.zeros > 0) answer.notes.push_back(zeros_said(test.zeros, pratt));
  if (exact) {
    answer.more.push_back({"smallest_p", test.smallest});
    answer.notes.push_back("Exact p-values come in steps; with these ranks none is below " +
                           in_words(test.smallest) + ".");
  }
  if (!shift.ci95)
    answer.notes.emplace_back("With so few, even the widest interval holds less than 95 %.");
  else if (ties || test.zeros > 0)
    answer.notes.emplace_back("The interval takes no account of ties and zeros: it holds 95 % or more.");
  // P(D + D′ > 0) by Noether: V counts pairs of differences whose sum is positive.
  say_detectable(answer, "detectable_probability", "a probability that the sum of two differences is positive",
                 detectable_probability(1.0 / std::sqrt(3.0 * n), kPlannedPower, kAlpha), 1.0);
  return settled(std::move(answer));
}

}  // namespace seldinger::assessment::statistics
