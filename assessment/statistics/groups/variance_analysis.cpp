#include "assessment/statistics/groups/variance_analysis.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "assessment/statistics/distributions.h"
#include "assessment/statistics/groups/describe.h"
#include "assessment/statistics/groups/power.h"
#include "assessment/statistics/groups/samples.h"
#include "assessment/statistics/spread.h"

namespace seldinger::assessment::statistics {
namespace {

std::vector<Spread> spreads_of(std::span<const Group> groups) {
  std::vector<Spread> spreads;
  for (const Group& group : groups) spreads.push_back(spread_of(group.values));
  return spreads;
}

const char* why_no_variance(std::span<const Spread> spreads) {
  bool varies = false;
  for (const Spread& spread : spreads) {
    if (!spread.computable) return "no_finite_answer";
    varies = varies || spread.varies;
  }
  return varies ? nullptr : "no_variation_within";
}

// Of the groups together: one whose values differ by rounding only adds nothing.
const char* why_no_pooled_variance(std::span<const Spread> spreads, double within) {
  bool varies = false;
  double largest = 0.0;
  for (const Spread& spread : spreads) {
    varies = varies || spread.varies;
    largest = std::max(largest, std::abs(spread.mean));
  }
  if (!varies) return "no_variation_within";
  const double sd = std::sqrt(within), rounding = 10.0 * std::numeric_limits<double>::epsilon() * largest;
  return std::isfinite(sd) && within >= std::numeric_limits<double>::min() && sd > rounding ? nullptr
                                                                                            : "no_finite_answer";
}

void tell_f(Answer& answer, const FTest& test) {
  answer.statistic = test.f;
  answer.df = {test.df1, test.df2};
  answer.p_value = test.p_value();
}

// Each group's values as distances from its median.
std::vector<Group> distances_from_median(std::span<const Group> groups) {
  std::vector<Group> distances;
  for (const Group& group : groups) {
    std::vector<double> sorted = group.values;
    std::sort(sorted.begin(), sorted.end());
    const double median = quantile_of(sorted, 0.5);
    distances.push_back({group.name, {}});
    for (const double value : group.values) distances.back().values.push_back(std::abs(value - median));
  }
  return distances;
}

}  // namespace

double FTest::p_value() const {
  return f_upper(f, df1, df2);
}

FTest one_way(std::span<const Group> groups) {
  const std::vector<Spread> spreads = spreads_of(groups);
  FTest test;
  double n = 0.0, sum = 0.0, within = 0.0, between = 0.0;
  for (const Spread& spread : spreads) {
    const double count = static_cast<double>(spread.n);
    n += count;
    sum += count * spread.mean;
    within += (count - 1.0) * spread.variance;
  }
  test.reason = why_no_pooled_variance(spreads, within / (n - static_cast<double>(groups.size())));
  if (test.reason != nullptr) return test;
  for (const Spread& spread : spreads)
    between += static_cast<double>(spread.n) * (spread.mean - sum / n) * (spread.mean - sum / n);
  test.df1 = static_cast<double>(groups.size()) - 1.0;
  test.df2 = n - static_cast<double>(groups.size());
  test.f = between / test.df1 / (within / test.df2);
  if (!std::isfinite(test.f)) test.reason = "no_finite_answer";
  return test;
}

FTest welch_one_way(std::span<const Group> groups) {
  const std::vector<Spread> spreads = spreads_of(groups);
  FTest test;
  test.reason = why_no_variance(spreads);
  if (test.reason != nullptr) return test;
  double weights = 0.0, weighted = 0.0, between = 0.0, lack = 0.0;
  for (const Spread& spread : spreads) {
    if (!spread.varies) {
      test.reason = "no_variation";  // its weight has no bound
      return test;
    }
    const double weight = static_cast<double>(spread.n) / spread.variance;
    weights += weight;
    weighted += weight * spread.mean;
  }
  for (const Spread& spread : spreads) {
    const double weight = static_cast<double>(spread.n) / spread.variance, off = spread.mean - weighted / weights;
    between += weight * off * off;
    lack += (1.0 - weight / weights) * (1.0 - weight / weights) / (static_cast<double>(spread.n) - 1.0);
  }
  const double k = static_cast<double>(groups.size());
  test.df1 = k - 1.0;
  test.df2 = (k * k - 1.0) / (3.0 * lack);
  test.f = between / (k - 1.0) / (1.0 + 2.0 * (k - 2.0) * lack / (k * k - 1.0));
  if (!std::isfinite(test.f)) test.reason = "no_finite_answer";
  return test;
}

Answer welch_anova(const DataTable& table, const ProcedureOptions& options) {
  GroupsAsked asked = several_groups(table, options, 2);
  if (asked.reason != nullptr) return asked.refused("welch_anova");
  const std::vector<Group>& groups = asked.groups.groups;
  const FTest test = welch_one_way(groups);
  if (test.reason != nullptr) {
    asked.reason = test.reason;
    if (test.reason == std::string("no_variation"))
      asked.notes.emplace_back("A group whose values do not vary would outweigh all others.");
    return asked.refused("welch_anova");
  }
  Answer answer = asked.answer("welch_anova", "Welch's analysis of variance, unequal variances");
  tell_f(answer, test);
  const double n = static_cast<double>(asked.groups.n);
  // Negative where the groups differ less than chance lets them; shown as it is.
  answer.estimate = test.df1 * (test.f - 1.0) / (test.df1 * (test.f - 1.0) + n);
  answer.estimate_name = "ω², share of variance that groups explain";
  for (const Group& group : groups) {
    const Spread spread = spread_of(group.values);
    answer.rows.push_back({group.name, {{"mean", spread.mean}, {"sd", std::sqrt(spread.variance)}}});
  }
  say_detectable(answer, "detectable_f", "Cohen's f (SD of the groups' means in SDs of persons)",
                 detectable_f(static_cast<double>(groups.size()), n, kPlannedPower, kAlpha), 1e3);
  return settled(std::move(answer));
}

Answer brown_forsythe(const DataTable& table, const ProcedureOptions& options) {
  GroupsAsked asked = several_groups(table, options, 2);
  if (asked.reason != nullptr) return asked.refused("brown_forsythe");
  const FTest test = one_way(distances_from_median(asked.groups.groups));
  if (test.reason != nullptr) {
    asked.reason = test.reason;
    return asked.refused("brown_forsythe");
  }
  Answer answer = asked.answer("brown_forsythe", "Brown–Forsythe, one-way on distances from the median");
  tell_f(answer, test);
  for (const Group& group : asked.groups.groups)
    answer.rows.push_back({group.name, {{"sd", std::sqrt(spread_of(group.values).variance)}}});
  answer.notes.emplace_back("Do not choose a test of means by it: Welch's does not need equal variances.");
  say_detectable(answer, "detectable_f", "Cohen's f of the distances",
                 detectable_f(static_cast<double>(asked.groups.groups.size()), static_cast<double>(asked.groups.n),
                              kPlannedPower, kAlpha),
                 1e3);
  return settled(std::move(answer));
}

}  // namespace seldinger::assessment::statistics
