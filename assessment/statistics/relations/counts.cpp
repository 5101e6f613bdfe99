#include "assessment/statistics/relations/counts.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>

#include "assessment/statistics/distributions.h"
#include "assessment/statistics/relations/observations.h"
#include "assessment/statistics/relations/proportions.h"
#include "assessment/statistics/roots.h"

namespace seldinger::assessment::statistics {
namespace {

// R's: what is as probable up to rounding counts as as probable.
constexpr double kAsLikely = 1.0 + 1e-7;

double sum_of(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0);
}

// P(a count no more probable than k), k of n with chance p each. Probabilities fall on both sides of n·p.
double binomial_two_sided(std::int64_t k, std::int64_t n, double p) {
  const double expected = static_cast<double>(n) * p;
  if (static_cast<double>(k) > expected) return binomial_two_sided(n - k, n, 1.0 - p);
  const double limit = binomial_pdf(k, n, p) * kAsLikely;
  std::int64_t low = static_cast<std::int64_t>(std::ceil(expected)), high = n + 1;
  while (low < high) {
    const std::int64_t middle = low + (high - low) / 2;
    if (binomial_pdf(middle, n, p) <= limit) {
      high = middle;
    } else {
      low = middle + 1;
    }
  }
  if (low <= k) return 1.0;
  return std::min(1.0, binomial_cdf(k, n, p) + binomial_cdf(n - low, n, 1.0 - p));
}

// Both groups, and why they cannot be compared.
struct TwoCounted {
  Observations rows;
  Counted first, second;
  const char* reason = nullptr;
  const char* note = nullptr;
};

TwoCounted two_counted(const DataTable& table, const ProcedureOptions& options, std::size_t least) {
  TwoCounted two{.rows = observations(table, {.x = true, .group = true}, options), .first = {}, .second = {}};
  const Observations& rows = two.rows;
  two.reason = not_two_groups(rows, least);
  if (two.reason != nullptr) return two;
  if (!all_counts(rows.values[0])) {
    two.reason = "bad_value";
    two.note = "A count is a whole number from 0.";
    return two;
  }
  two.first = {rows.values_of(0), rows.x_of(0)};
  two.second = {rows.values_of(1), rows.x_of(1)};
  if (rows.x.empty()) {
    two.first.exposures.assign(two.first.counts.size(), 1.0);
    two.second.exposures.assign(two.second.counts.size(), 1.0);
  }
  if (std::any_of(rows.x.begin(), rows.x.end(), [](double one) { return !(one > 0.0); })) {
    two.reason = "bad_value";
    two.note = "An exposure is a number above 0.";
  } else if (sum_of(rows.values[0]) == 0.0) {
    two.reason = "no_event";
  }
  return two;
}

// Whether persons differ more than Poisson's distribution lets them, at 5 %.
bool overdispersed(const TwoCounted& two) {
  double chi_squared = 0.0;
  for (const Counted* group : {&two.first, &two.second}) {
    const double rate = sum_of(group->counts) / sum_of(group->exposures);
    if (rate == 0.0) continue;
    for (std::size_t i = 0; i < group->counts.size(); ++i) {
      const double mean = rate * group->exposures[i];
      chi_squared += (group->counts[i] - mean) * (group->counts[i] - mean) / mean;
    }
  }
  const double df = static_cast<double>(two.rows.n) - 2.0;
  return df > 0.0 && chi_squared_upper(chi_squared, df) < 0.05;
}

// The rate of one group at θ: where Σ (y − λe)/(1 + λe/θ), which falls in λ, is 0.
double rate_at(const Counted& group, double theta) {
  const double pooled = sum_of(group.counts) / sum_of(group.exposures);
  const auto [least, most] = std::minmax_element(group.exposures.begin(), group.exposures.end());
  if (*least == *most) return pooled;
  double highest = 0.0;
  for (std::size_t i = 0; i < group.counts.size(); ++i)
    highest = std::max(highest, group.counts[i] / group.exposures[i]);
  return root_between(0.0, highest, [&](double rate) {
    double sum = 0.0;
    for (std::size_t i = 0; i < group.counts.size(); ++i) {
      const double mean = rate * group.exposures[i];
      sum += (group.counts[i] - mean) / (1.0 + mean / theta);
    }
    return sum;
  });
}

// ψ(y + θ) − ψ(θ); for small counts by their sum, which keeps its digits at a large θ.
double digamma_step(double theta, double count) {
  if (count > 1000.0) return digamma(count + theta) - digamma(theta);
  double sum = 0.0;
  for (double j = 0.0; j < count; ++j) sum += 1.0 / (theta + j);
  return sum;
}

double theta_score(const Counted& group, double theta) {
  const double rate = rate_at(group, theta);
  double score = 0.0;
  for (std::size_t i = 0; i < group.counts.size(); ++i) {
    const double mean = rate * group.exposures[i], count = group.counts[i];
    score += digamma_step(theta, count) - std::log1p(mean / theta) + (mean - count) / (mean + theta);
  }
  return score;
}

// Σ (y − µ)² − y at Poisson's rate: above 0, persons differ more than by chance and θ is finite.
double excess(const Counted& group) {
  const double rate = sum_of(group.counts) / sum_of(group.exposures);
  double sum = 0.0;
  for (std::size_t i = 0; i < group.counts.size(); ++i) {
    const double off = group.counts[i] - rate * group.exposures[i];
    sum += off * off - group.counts[i];
  }
  return sum;
}

double information(const Counted& group, double rate, double inverse_theta) {
  double sum = 0.0;
  for (const double exposure : group.exposures) sum += rate * exposure / (1.0 + rate * exposure * inverse_theta);
  return sum;
}

}  // namespace

PoissonRatio poisson_ratio(std::int64_t k1, double exposure1, std::int64_t k2, double exposure2) {
  const std::int64_t events = k1 + k2;
  PoissonRatio found;
  found.p_value = binomial_two_sided(k1, events, exposure1 / (exposure1 + exposure2));
  const double scale = exposure2 / exposure1;
  const Interval share = clopper_pearson_interval(k1, events);
  found.low = share.low / (1.0 - share.low) * scale;
  if (k2 > 0) {
    found.ratio = static_cast<double>(k1) / static_cast<double>(k2) * scale;
    found.high = share.high / (1.0 - share.high) * scale;
  }
  return found;
}

NegativeBinomial negative_binomial_of(const Counted& first, const Counted& second) {
  NegativeBinomial found;
  double inverse_theta = 0.0, rate1 = sum_of(first.counts) / sum_of(first.exposures);
  double rate2 = sum_of(second.counts) / sum_of(second.exposures);
  if (excess(first) + excess(second) > 0.0) {
    const double log_theta = root_between(std::log(1e-6), std::log(1e9), [&](double at) {
      return theta_score(first, std::exp(at)) + theta_score(second, std::exp(at));
    });
    if (std::isfinite(log_theta)) {
      found.theta = std::exp(log_theta);
      inverse_theta = 1.0 / *found.theta;
      rate1 = rate_at(first, *found.theta);
      rate2 = rate_at(second, *found.theta);
    }
  }
  found.log_ratio = std::log(rate1) - std::log(rate2);
  found.standard_error =
      std::sqrt(1.0 / information(first, rate1, inverse_theta) + 1.0 / information(second, rate2, inverse_theta));
  return found;
}

Answer poisson(const DataTable& table, const ProcedureOptions& options) {
  const TwoCounted two = two_counted(table, options, 1);
  if (two.reason != nullptr) return refused("poisson", two.reason, two.rows, two.note);
  const double k1 = sum_of(two.first.counts), k2 = sum_of(two.second.counts);
  const double exposure1 = sum_of(two.first.exposures), exposure2 = sum_of(two.second.exposures);
  const double share = exposure1 / (exposure1 + exposure2);
  if (!(share > 0.0 && share < 1.0) || !std::isfinite(exposure1 + exposure2) || k1 + k2 > 1e12)
    return refused("poisson", "no_finite_answer", two.rows);
  const PoissonRatio ratio =
      poisson_ratio(static_cast<std::int64_t>(k1), exposure1, static_cast<std::int64_t>(k2), exposure2);
  Answer answer = begun("poisson", two.rows);
  answer.method = "ratio of two Poisson rates, exact given the sum of counts, two-sided: counts no more probable";
  answer.estimate_name = "rate ratio (" + two.rows.groups[0] + " / " + two.rows.groups[1] + ")";
  answer.p_value = ratio.p_value;
  answer.estimate = ratio.ratio;
  if (ratio.high) answer.ci95 = Interval{ratio.low, *ratio.high};
  answer.more = {
      {"events_first", k1}, {"events_second", k2}, {"rate_first", k1 / exposure1}, {"rate_second", k2 / exposure2}};
  if (!ratio.ratio) {
    answer.more.push_back({"rate_ratio_low", ratio.low});
    answer.notes.emplace_back(
        "The second group has no event: the ratio has no upper bound; `rate_ratio_low` is its lower one (97.5 %, "
        "one-sided).");
  }
  if (overdispersed(two))
    answer.notes.emplace_back(
        "Persons differ more than Poisson's distribution allows: this interval is too narrow; take "
        "negative_binomial.");
  return settled(std::move(answer));
}

Answer negative_binomial(const DataTable& table, const ProcedureOptions& options) {
  const TwoCounted two = two_counted(table, options, 2);
  if (two.reason != nullptr) return refused("negative_binomial", two.reason, two.rows, two.note);
  if (sum_of(two.first.counts) == 0.0 || sum_of(two.second.counts) == 0.0)
    return refused("negative_binomial", "perfect_separation", two.rows,
                   "A group has no event; poisson is exact in that case.");
  const NegativeBinomial fit = negative_binomial_of(two.first, two.second);
  Answer answer = begun("negative_binomial", two.rows);
  answer.method = "negative binomial regression by maximum likelihood, one dispersion, Wald test and interval";
  answer.estimate_name = "rate ratio (" + two.rows.groups[0] + " / " + two.rows.groups[1] + ")";
  answer.estimate = std::exp(fit.log_ratio);
  const double half = normal_quantile_of(0.975) * fit.standard_error;
  answer.ci95 = Interval{std::exp(fit.log_ratio - half), std::exp(fit.log_ratio + half)};
  answer.statistic = fit.log_ratio / fit.standard_error;
  answer.p_value = 2.0 * normal_upper(std::abs(*answer.statistic));
  answer.more = {{"log_rate_ratio", fit.log_ratio}, {"standard_error", fit.standard_error}};
  if (fit.theta) {
    answer.more.push_back({"theta", *fit.theta});
  } else {
    answer.notes.emplace_back("Persons differ no more than by chance: θ is unbounded, the fit is Poisson's.");
  }
  warn_of_interval(answer, 50);
  warn_of_test(answer, 100);
  return settled(std::move(answer));
}

}  // namespace seldinger::assessment::statistics
