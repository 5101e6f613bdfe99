#include "assessment/statistics/groups/mann_whitney.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include "assessment/statistics/distributions.h"
#include "assessment/statistics/groups/pairwise.h"
#include "assessment/statistics/groups/power.h"
#include "assessment/statistics/groups/rank_sums.h"
#include "assessment/statistics/groups/samples.h"
#include "assessment/statistics/ranks.h"

namespace seldinger::assessment::statistics {
namespace {

std::vector<double> both(std::span<const double> a, std::span<const double> b) {
  std::vector<double> all(a.begin(), a.end());
  all.insert(all.end(), b.begin(), b.end());
  return all;
}

std::vector<double> ascending(std::span<const double> values) {
  std::vector<double> sorted(values.begin(), values.end());
  std::sort(sorted.begin(), sorted.end());
  return sorted;
}

// From either end of the ordered differences, which bounds a 95 % interval; 0: none does.
std::size_t critical_difference(std::size_t n1, std::size_t n2) {
  const double product = static_cast<double>(n1) * static_cast<double>(n2);
  if (n1 + n2 > kMostExact) {
    const double sd = std::sqrt(product * static_cast<double>(n1 + n2 + 1) / 12.0);
    return static_cast<std::size_t>(std::max(0.0, std::floor(0.5 * product - normal_quantile_of(0.975) * sd)));
  }
  std::vector<int> ranks(n1 + n2);
  std::iota(ranks.begin(), ranks.end(), 1);
  const std::vector<double> chances = chances_of_draws(ranks, n1);
  return critical_sum(std::span(chances).subspan(n1 * (n1 + 1) / 2), 0.025);
}

bool all_the_same(std::span<const double> a, std::span<const double> b) {
  const auto is_first = [&](double value) { return value == a.front(); };
  return std::all_of(a.begin(), a.end(), is_first) && std::all_of(b.begin(), b.end(), is_first);
}

}  // namespace

RankSumTest exact_rank_sum(std::span<const double> a, std::span<const double> b) {
  const WholeRanks whole = whole_ranks(midranks(both(a, b)));
  const int n1 = static_cast<int>(a.size()), n = static_cast<int>(whole.scores.size());
  const int sum = std::accumulate(whole.scores.begin(), whole.scores.begin() + n1, 0);
  const std::vector<double> chances = chances_of_draws(whole.scores, a.size());
  const ExactTest test = exact_test(chances, sum, whole.unit * n1 * (n + 1));
  const double u = static_cast<double>(sum) / whole.unit - 0.5 * n1 * (n1 + 1);
  return {u, std::min(1.0, test.two_sided), std::min(1.0, test.upper), test.smallest};
}

RankSumTest normal_rank_sum(std::span<const double> a, std::span<const double> b, bool continuity_correction) {
  const std::vector<double> all = both(a, b);
  const std::vector<double> ranks = midranks(all);
  const double n1 = static_cast<double>(a.size()), n2 = static_cast<double>(b.size()), n = n1 + n2;
  const auto end_of_a = ranks.begin() + static_cast<std::ptrdiff_t>(a.size());
  RankSumTest test;
  test.u = std::accumulate(ranks.begin(), end_of_a, 0.0) - 0.5 * n1 * (n1 + 1.0);
  const double off = test.u - 0.5 * n1 * n2;
  const double sd = std::sqrt(n1 * n2 / 12.0 * (n + 1.0 - tie_sum(all) / (n * (n - 1.0))));
  const double correction = continuity_correction ? 0.5 : 0.0;
  test.p_value = two_sided_normal(std::max(0.0, std::abs(off) - correction) / sd);
  test.p_upper = normal_upper((off - correction) / sd);
  return test;
}

Shift hodges_lehmann(std::span<const double> a, std::span<const double> b) {
  const std::vector<double> of_a = ascending(a), of_b = ascending(b);
  const std::size_t pairs = a.size() * b.size();
  const double lower = kth_difference(of_a, of_b, (pairs + 1) / 2),
               upper = kth_difference(of_a, of_b, pairs / 2 + 1);
  Shift shift{0.5 * lower + 0.5 * upper, std::nullopt};
  if (const std::size_t k = critical_difference(a.size(), b.size()); k > 0)
    shift.ci95 = Interval{kth_difference(of_a, of_b, k), kth_difference(of_a, of_b, pairs + 1 - k)};
  return shift;
}

Answer mann_whitney(const DataTable& table, const ProcedureOptions& options) {
  const std::string method = options.text("method", "auto");
  if (method != "auto" && method != "asymptotic")
    return bad_option("mann_whitney", "method is auto or asymptotic.");
  GroupsAsked asked = two_groups(table, options, 1);
  if (asked.reason != nullptr) return asked.refused("mann_whitney");
  const Group &a = asked.groups.groups[0], &b = asked.groups.groups[1];
  if (all_the_same(a.values, b.values)) {
    asked.reason = "all_tied";
    return asked.refused("mann_whitney");
  }
  const bool exact = method == "auto" && asked.groups.n <= kMostExact,
             ties = tie_sum(both(a.values, b.values)) > 0.0;
  const RankSumTest test = exact ? exact_rank_sum(a.values, b.values) : normal_rank_sum(a.values, b.values, true);
  Answer answer =
      asked.answer("mann_whitney", exact ? std::string("Mann–Whitney, two-sided, exact") +
                                               (ties ? " given the ties, mid-ranks" : "")
                                         : "Mann–Whitney, two-sided, asymptotic, continuity correction" +
                                               std::string(ties ? ", variance corrected for ties" : ""));
  const Shift shift = hodges_lehmann(a.values, b.values);
  const double n1 = static_cast<double>(a.values.size()), n2 = static_cast<double>(b.values.size());
  answer.statistic = test.u;
  answer.p_value = test.p_value;
  answer.estimate = shift.estimate;
  answer.estimate_name = "Hodges–Lehmann shift (" + a.name + " − " + b.name + ")";
  answer.ci95 = shift.ci95;
  const double probability = test.u / (n1 * n2);
  answer.more = {{"probability_first_larger", probability}, {"cliff_delta", 2.0 * probability - 1.0}};
  if (exact) {
    answer.more.push_back({"smallest_p", test.smallest});
    answer.notes.push_back("Exact p-values come in steps; with these ranks none is below " +
                           in_words(test.smallest) + ".");
  }
  if (!shift.ci95)
    answer.notes.emplace_back("With so few, even the widest interval of the shift holds less than 95 %.");
  else if (ties)
    answer.notes.emplace_back("The interval takes no account of ties: it holds 95 % or more.");
  answer.notes.emplace_back(
      "It tests that both groups have one distribution; the shift is one only where their shapes are alike.");
  say_detectable(answer, "detectable_probability", "a probability that one group's value is the larger",
                 detectable_probability(std::sqrt((n1 + n2) / (12.0 * n1 * n2)), kPlannedPower, kAlpha), 1.0);
  return settled(std::move(answer));
}

}  // namespace seldinger::assessment::statistics
