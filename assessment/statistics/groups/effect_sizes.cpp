#include "assessment/statistics/groups/effect_sizes.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "assessment/statistics/distributions.h"
#include "assessment/statistics/groups/brunner_munzel.h"
#include "assessment/statistics/groups/power.h"
#include "assessment/statistics/groups/samples.h"
#include "assessment/statistics/roots.h"
#include "assessment/statistics/spread.h"

namespace seldinger::assessment::statistics {
namespace {

// Both samples' spreads and sizes.
struct TwoSpreads {
  Spread a, b;
  double n1 = 0.0, n2 = 0.0;

  double difference() const { return a.mean - b.mean; }
};

TwoSpreads two_spreads(std::span<const double> a, std::span<const double> b) {
  return {spread_of(a), spread_of(b), static_cast<double>(a.size()), static_cast<double>(b.size())};
}

// A difference in standard deviations: `t` has non-central t of `df`, `scale` takes a non-centrality to the effect.
Effect by_noncentrality(double value, double t, double df, double scale) {
  Effect effect{value, std::nullopt};
  if (const std::optional<Interval> interval = noncentrality_interval(t, df))
    effect.ci95 = Interval{interval->low * scale, interval->high * scale};
  return effect;
}

void add_row(Answer& answer, const char* name, const Effect& effect) {
  Row row{name, {{"value", effect.value}}};
  if (effect.ci95) {
    row.values.push_back({"ci95_low", effect.ci95->low});
    row.values.push_back({"ci95_high", effect.ci95->high});
  }
  answer.rows.push_back(std::move(row));
}

// Of differences in standard deviations; nullptr: they can be computed.
const char* why_no_deviations(const Spread& a, const Spread& b) {
  if (!a.computable || !b.computable) return "no_finite_answer";
  return a.varies || b.varies ? nullptr : "no_variation_within";
}

void add_deviations(Answer& answer, const Group& a, const Group& b) {
  const Effect d = cohen_d(a.values, b.values);
  answer.estimate = d.value;
  answer.estimate_name = "Cohen's d (" + a.name + " − " + b.name + ")";
  answer.ci95 = d.ci95;
  add_row(answer, "cohen_d", d);
  add_row(answer, "hedges_g", hedges_g(a.values, b.values));
  if (spread_of(b.values).varies)
    add_row(answer, "glass_delta", glass_delta(a.values, b.values));
  else
    answer.notes.push_back("Glass's Δ has none to divide by: " + b.name + " does not vary.");
  add_row(answer, "d_unpooled", unpooled_d(a.values, b.values));
}

}  // namespace

std::optional<Interval> noncentrality_interval(double t, double df) {
  // Further out Boost's series no longer end in time, and no interval of an effect is of use.
  constexpr double kFurthest = 500.0;
  if (!(std::abs(t) <= kFurthest) || !(df >= 1.0)) return std::nullopt;
  const double wide = 8.0 * std::sqrt(1.0 + 0.5 * t * t / df);
  const auto limit = [&](double share) {
    return root_between(t - wide, t + wide, [&](double delta) { return noncentral_t_cdf(t, df, delta) - share; });
  };
  const Interval interval{limit(0.975), limit(0.025)};
  return std::isfinite(interval.low) && std::isfinite(interval.high) ? std::optional(interval) : std::nullopt;
}

Effect cohen_d(std::span<const double> a, std::span<const double> b) {
  const TwoSpreads of = two_spreads(a, b);
  const double df = of.n1 + of.n2 - 2.0;
  const double sd = std::sqrt((of.n1 - 1.0) / df * of.a.variance + (of.n2 - 1.0) / df * of.b.variance);
  const double scale = std::sqrt(1.0 / of.n1 + 1.0 / of.n2), d = of.difference() / sd;
  return by_noncentrality(d, d / scale, df, scale);
}

Effect hedges_g(std::span<const double> a, std::span<const double> b) {
  Effect effect = cohen_d(a, b);
  const double half = 0.5 * static_cast<double>(a.size() + b.size() - 2);
  const double factor = std::exp(log_gamma(half) - log_gamma(half - 0.5)) / std::sqrt(half);
  effect.value *= factor;
  if (effect.ci95) effect.ci95 = Interval{effect.ci95->low * factor, effect.ci95->high * factor};
  return effect;
}

Effect glass_delta(std::span<const double> a, std::span<const double> b) {
  const TwoSpreads of = two_spreads(a, b);
  const double ratio = of.a.variance / of.b.variance, scale = std::sqrt(1.0 / of.n2 + ratio / of.n1);
  const double delta = of.difference() / std::sqrt(of.b.variance);
  return by_noncentrality(delta, delta / scale, of.n2 - 1.0, scale);
}

Effect unpooled_d(std::span<const double> a, std::span<const double> b) {
  const TwoSpreads of = two_spreads(a, b);
  const double mean_variance = 0.5 * of.a.variance + 0.5 * of.b.variance;
  const double share1 = of.a.variance / mean_variance / of.n1, share2 = of.b.variance / mean_variance / of.n2;
  const double scale = std::sqrt(share1 + share2), d = of.difference() / std::sqrt(mean_variance);
  const double part1 = share1 / (share1 + share2), part2 = share2 / (share1 + share2);
  const double df = 1.0 / (part1 * part1 / (of.n1 - 1.0) + part2 * part2 / (of.n2 - 1.0));
  return by_noncentrality(d, d / scale, df, scale);
}

Effect cliff_delta(std::span<const double> a, std::span<const double> b) {
  const Effect by_superiority = cliff_delta_by_superiority(a, b);
  const double delta = by_superiority.value;
  if (std::abs(delta) == 1.0) return by_superiority;
  const double n1 = static_cast<double>(a.size()), n2 = static_cast<double>(b.size());
  const double wide = normal_quantile_of(0.975) * std::sqrt((n1 + n2 + 1.0) / (3.0 * n1 * n2));
  return {delta, Interval{std::tanh(std::atanh(delta) - wide), std::tanh(std::atanh(delta) + wide)}};
}

Effect cliff_delta_by_superiority(std::span<const double> a, std::span<const double> b) {
  const Superiority found = superiority(a, b);
  const Interval probability =
      superiority_interval(found, static_cast<double>(a.size()), static_cast<double>(b.size()));
  return {2.0 * found.estimate - 1.0, Interval{2.0 * probability.low - 1.0, 2.0 * probability.high - 1.0}};
}

Answer effect_size(const DataTable& table, const ProcedureOptions& options) {
  GroupsAsked asked = two_groups(table, options, 2);
  if (asked.reason != nullptr) return asked.refused("effect_size");
  const Group &a = asked.groups.groups[0], &b = asked.groups.groups[1];
  const Spread of_a = spread_of(a.values), of_b = spread_of(b.values);
  const bool all_same = !of_a.varies && !of_b.varies && a.values.front() == b.values.front();
  if (all_same) {
    asked.reason = "no_variation";
    return asked.refused("effect_size");
  }
  Answer answer =
      asked.answer("effect_size", "differences in standard deviations, non-central t intervals; Cliff's δ");
  const Effect delta = cliff_delta(a.values, b.values), safer = cliff_delta_by_superiority(a.values, b.values);
  if (const char* reason = why_no_deviations(of_a, of_b); reason == nullptr) {
    add_deviations(answer, a, b);
    if (!answer.ci95) answer.notes.emplace_back("The difference is too large for an interval.");
  } else {
    answer.estimate = delta.value;
    answer.estimate_name = "Cliff's δ (" + a.name + " − " + b.name + ")";
    answer.ci95 = safer.ci95;
    answer.notes.emplace_back("There is no standard deviation to divide by: δ only.");
  }
  add_row(answer, "cliff_delta", delta);
  add_row(answer, "cliff_delta_logit", safer);
  answer.notes.emplace_back(
      "cliff_delta is the rank-biserial correlation as well; Glass's Δ divides by the second group's SD.");
  if (std::abs(delta.value) == 1.0)
    answer.notes.emplace_back("The groups do not overlap: δ has Newcombe's interval.");
  else
    answer.notes.emplace_back(
        "cliff_delta's interval by Fisher's z holds 83 to 95 % instead of 95, least where δ is large; "
        "cliff_delta_logit "
        "has Brunner–Munzel's, which held 95 % and more.");
  answer.more = {{"detectable_d", t_test_detectable(static_cast<double>(a.values.size()),
                                                    static_cast<double>(b.values.size()), kPlannedPower, kAlpha)}};
  return settled(std::move(answer));
}

}  // namespace seldinger::assessment::statistics
