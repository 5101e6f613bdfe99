#include "assessment/statistics/groups/rank_tests.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <string>
#include <utility>

#include "assessment/statistics/distributions.h"
#include "assessment/statistics/groups/multiplicity.h"
#include "assessment/statistics/groups/power.h"
#include "assessment/statistics/groups/samples.h"
#include "assessment/statistics/ranks.h"

namespace seldinger::assessment::statistics {
namespace {

struct PooledRanks {
  std::vector<double> mean;  // of each group
  double n = 0.0, ties = 0.0;
  // What n(n + 1)/12 becomes with ties; 0: all values are the same.
  double variance() const { return n * (n + 1.0) / 12.0 - ties / (12.0 * (n - 1.0)); }
};

std::vector<double> all_values(std::span<const Group> groups) {
  std::vector<double> values;
  for (const Group& group : groups) values.insert(values.end(), group.values.begin(), group.values.end());
  return values;
}

PooledRanks pooled_ranks(std::span<const Group> groups) {
  const std::vector<double> values = all_values(groups), ranks = midranks(values);
  PooledRanks pooled;
  pooled.n = static_cast<double>(values.size());
  pooled.ties = tie_sum(values);
  std::size_t next = 0;
  for (const Group& group : groups) {
    double sum = 0.0;
    for (std::size_t i = 0; i < group.values.size(); ++i) sum += ranks[next++];
    pooled.mean.push_back(sum / static_cast<double>(group.values.size()));
  }
  return pooled;
}

bool is_tied_throughout(std::span<const Group> groups) {
  const std::vector<double> values = all_values(groups);
  return std::adjacent_find(values.begin(), values.end(), std::not_equal_to<>()) == values.end();
}

void flag_small_groups(Answer& answer) {
  for (const GroupCount& group : answer.groups)
    if (group.n < 5) {
      answer.notes.emplace_back("A group has fewer than five: the approximation is rough.");
      return;
    }
}

// Groups of one or more whose values are not all the same.
GroupsAsked ranked_groups(const DataTable& table, const ProcedureOptions& options) {
  GroupsAsked asked = several_groups(table, options, 1);
  if (asked.reason != nullptr) return asked;
  if (asked.groups.n < 3)
    asked.reason = "too_few";
  else if (is_tied_throughout(asked.groups.groups))
    asked.reason = "all_tied";
  return asked;
}

// Σ over groups of t equal values, of a product of what is left after taking 0, 1, … from t.
struct TieSums {
  double large = 0.0;  // t(t − 1)(2t + 5)
  double three = 0.0;  // t(t − 1)(t − 2)
  double two = 0.0;    // t(t − 1)

  void add(double t) {
    large += t * (t - 1.0) * (2.0 * t + 5.0);
    three += t * (t - 1.0) * (t - 2.0);
    two += t * (t - 1.0);
  }
};

double pairs_in_order(const Group& lower, const Group& higher) {
  std::vector<double> sorted = lower.values;
  std::sort(sorted.begin(), sorted.end());
  double pairs = 0.0;
  for (const double value : higher.values) {
    const auto [from, to] = std::equal_range(sorted.begin(), sorted.end(), value);
    pairs += static_cast<double>(from - sorted.begin()) + 0.5 * static_cast<double>(to - from);
  }
  return pairs;
}

struct FriedmanSums {
  std::vector<double> rank_sum;  // of each condition
  double ties = 0.0;
};

FriedmanSums friedman_sums(const Blocks& blocks) {
  FriedmanSums sums{std::vector<double>(blocks.conditions.size(), 0.0), 0.0};
  for (const std::vector<double>& person : blocks.values) {
    const std::vector<double> ranks = midranks(person);
    sums.ties += tie_sum(person);
    for (std::size_t i = 0; i < ranks.size(); ++i) sums.rank_sum[i] += ranks[i];
  }
  return sums;
}

}  // namespace

Answer kruskal(const DataTable& table, const ProcedureOptions& options) {
  GroupsAsked asked = ranked_groups(table, options);
  if (asked.reason != nullptr) return asked.refused("kruskal");
  const PooledRanks ranks = pooled_ranks(asked.groups.groups);
  double between = 0.0;
  for (std::size_t i = 0; i < ranks.mean.size(); ++i) {
    const double off = ranks.mean[i] - 0.5 * (ranks.n + 1.0);
    between += static_cast<double>(asked.groups.groups[i].values.size()) * off * off;
  }
  const double h = between / ranks.variance(), df = static_cast<double>(ranks.mean.size()) - 1.0;
  Answer answer = asked.answer("kruskal", ranks.ties > 0.0 ? "Kruskal–Wallis, χ² approximation, corrected for ties"
                                                           : "Kruskal–Wallis, χ² approximation");
  answer.statistic = h;
  answer.df = {df};
  answer.p_value = chi_squared_upper(h, df);
  answer.estimate = h / (ranks.n - 1.0);
  answer.estimate_name = "ε², share of the ranks' variance that groups explain";
  for (std::size_t i = 0; i < ranks.mean.size(); ++i)
    answer.rows.push_back({asked.groups.groups[i].name, {{"mean_rank", ranks.mean[i]}}});
  flag_small_groups(answer);
  say_detectable(answer, "detectable_epsilon_squared", "an ε²",
                 detectable_noncentrality(df, kPlannedPower, kAlpha) / (ranks.n - 1.0), 1.0);
  return settled(std::move(answer));
}

std::vector<DunnPair> dunn_pairs(std::span<const Group> groups) {
  const PooledRanks ranks = pooled_ranks(groups);
  std::vector<DunnPair> pairs;
  std::vector<double> p_values;
  for (std::size_t i = 0; i < groups.size(); ++i)
    for (std::size_t j = i + 1; j < groups.size(); ++j) {
      const double share =
          1.0 / static_cast<double>(groups[i].values.size()) + 1.0 / static_cast<double>(groups[j].values.size());
      const double z = (ranks.mean[j] - ranks.mean[i]) / std::sqrt(ranks.variance() * share);
      pairs.push_back({i, j, z, two_sided_normal(z), 1.0});
      p_values.push_back(pairs.back().p_value);
    }
  const std::vector<double> adjusted = holm_adjusted(p_values);
  for (std::size_t i = 0; i < pairs.size(); ++i) pairs[i].p_holm = adjusted[i];
  return pairs;
}

Answer dunn(const DataTable& table, const ProcedureOptions& options) {
  GroupsAsked asked = ranked_groups(table, options);
  if (asked.reason != nullptr) return asked.refused("dunn");
  const std::vector<Group>& groups = asked.groups.groups;
  Answer answer = asked.answer("dunn", "Dunn's pairs by mean ranks of all, two-sided, corrected for ties, Holm");
  const PooledRanks ranks = pooled_ranks(groups);
  for (const DunnPair& pair : dunn_pairs(groups))
    answer.rows.push_back({groups[pair.first].name + " – " + groups[pair.second].name,
                           {{"mean_rank_difference", ranks.mean[pair.second] - ranks.mean[pair.first]},
                            {"z", pair.z},
                            {"p", pair.p_value},
                            {"p_holm", pair.p_holm}}});
  answer.notes.push_back("z is above 0 where the second of a pair is the higher; p_holm holds the family of " +
                         std::to_string(answer.rows.size()) + (answer.rows.size() == 1 ? " pair." : " pairs."));
  flag_small_groups(answer);
  return settled(std::move(answer));
}

double Trend::z() const {
  return (j - expected) / std::sqrt(variance);
}

Trend jonckheere_trend(std::span<const Group> groups) {
  Trend trend;
  std::map<double, double> counts;
  TieSums of_groups, of_values;
  double n = 0.0, squares = 0.0;
  for (std::size_t i = 0; i < groups.size(); ++i) {
    const double size = static_cast<double>(groups[i].values.size());
    n += size;
    squares += size * size;
    of_groups.add(size);
    for (const double value : groups[i].values) counts[value] += 1.0;
    for (std::size_t j = i + 1; j < groups.size(); ++j) trend.j += pairs_in_order(groups[i], groups[j]);
  }
  for (const auto& [value, count] : counts) of_values.add(count);
  trend.pairs = 0.5 * (n * n - squares);
  trend.expected = 0.5 * trend.pairs;
  trend.variance = (n * (n - 1.0) * (2.0 * n + 5.0) - of_groups.large - of_values.large) / 72.0 +
                   of_groups.three * of_values.three / (36.0 * n * (n - 1.0) * (n - 2.0)) +
                   of_groups.two * of_values.two / (8.0 * n * (n - 1.0));
  return trend;
}

Answer jonckheere(const DataTable& table, const ProcedureOptions& options) {
  GroupsAsked asked = ranked_groups(table, options);
  if (asked.reason != nullptr) return asked.refused("jonckheere");
  std::string order;
  for (const Group& group : asked.groups.groups) order += (order.empty() ? "" : " < ") + group.name;
  const Trend trend = jonckheere_trend(asked.groups.groups);
  Answer answer = asked.answer(
      "jonckheere", "Jonckheere–Terpstra, one-sided for " + order + ", normal approximation, variance with ties");
  answer.statistic = trend.j;
  answer.p_value = normal_upper(trend.z());
  answer.estimate = trend.j / trend.pairs;
  answer.estimate_name = "share of pairs in the expected order, ties as halves";
  answer.more = {{"z", trend.z()},
                 {"expected", trend.expected},
                 {"variance", trend.variance},
                 {"p_two_sided", two_sided_normal(trend.z())}};
  if (!options.has("order"))
    answer.notes.emplace_back("The expected order was taken from the rows; order=a:b:c sets it.");
  flag_small_groups(answer);
  // One-sided at .05, as a two-sided test at .10.
  say_detectable(answer, "detectable_share", "a share of pairs in order",
                 detectable_probability(std::sqrt(trend.variance) / trend.pairs, kPlannedPower, 2.0 * kAlpha), 1.0);
  return settled(std::move(answer));
}

Answer friedman(const DataTable& table, const ProcedureOptions& options) {
  Blocks blocks = complete_blocks(table, options);
  if (blocks.reason == nullptr && blocks.values.size() < 2) blocks.reason = "too_few";
  if (blocks.reason != nullptr) return blocks.refused("friedman");
  const FriedmanSums sums = friedman_sums(blocks);
  const double n = static_cast<double>(blocks.values.size()), k = static_cast<double>(blocks.conditions.size());
  const double spread = n * k * (k + 1.0) - sums.ties / (k - 1.0);
  if (!(spread > 0.0)) {
    blocks.reason = "all_tied";
    return blocks.refused("friedman");
  }
  double off = 0.0;
  for (const double sum : sums.rank_sum) off += (sum - 0.5 * n * (k + 1.0)) * (sum - 0.5 * n * (k + 1.0));
  Answer answer = blocks.answer("friedman", sums.ties > 0.0 ? "Friedman, χ² approximation, corrected for ties"
                                                            : "Friedman, χ² approximation");
  const double chi_squared = 12.0 * off / spread;
  answer.statistic = chi_squared;
  answer.df = {k - 1.0};
  answer.p_value = chi_squared_upper(chi_squared, k - 1.0);
  answer.estimate = chi_squared / (n * (k - 1.0));
  answer.estimate_name = "Kendall's W, agreement of persons about the order";
  for (std::size_t i = 0; i < sums.rank_sum.size(); ++i)
    answer.rows.push_back({blocks.conditions[i], {{"mean_rank", sums.rank_sum[i] / n}}});
  if (n < 10.0) answer.notes.emplace_back("Fewer than ten persons: the approximation is rough.");
  say_detectable(answer, "detectable_w", "a W",
                 detectable_noncentrality(k - 1.0, kPlannedPower, kAlpha) / (n * (k - 1.0)), 1.0);
  return settled(std::move(answer));
}

}  // namespace seldinger::assessment::statistics
