#include "assessment/statistics/reliability/omega.h"

#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "assessment/statistics/distributions.h"
#include "assessment/statistics/percentile_bootstrap.h"
#include "assessment/statistics/reliability/one_factor.h"
#include "assessment/statistics/spread.h"

namespace seldinger::assessment::statistics {
namespace {

constexpr std::size_t kLargeEnough = 100;  // with 30 the interval covers less than .93: reliability_long_test.cpp

using Columns = std::vector<std::vector<double>>;

struct Omega {
  OneFactor factor;
  double standardized = 0.0, as_scored = 0.0;
};

double share_of_factor(const OneFactor& factor, const SquareMatrix* covariance) {
  double common = 0.0, own = 0.0;
  for (std::size_t i = 0; i < factor.loadings.size(); ++i) {
    const double variance = covariance != nullptr ? covariance->at(i, i) : 1.0;
    common += factor.loadings[i] * std::sqrt(variance);
    own += factor.uniquenesses[i] * variance;
  }
  return common * common / (common * common + own);
}

std::optional<Omega> omega_of(const Columns& columns) {
  const SquareMatrix covariance = covariance_of(columns);
  for (std::size_t i = 0; i < covariance.n; ++i)
    if (!(covariance.at(i, i) > 0.0)) return std::nullopt;
  std::optional<OneFactor> factor = one_factor(correlation_of(covariance));
  if (!factor) return std::nullopt;
  Omega found{std::move(*factor), 0.0, 0.0};
  found.standardized = share_of_factor(found.factor, nullptr);
  found.as_scored = share_of_factor(found.factor, &covariance);
  return found;
}

double logit(double share) {
  return std::log(share / (1.0 - share));
}

// Normal on the logit scale: of 2000 samples it covers what the percentiles of the draws do not
// (tests/assessment/statistics/reliability).
std::optional<Interval> logit_interval(double value, const std::vector<double>& drawn) {
  std::vector<double> logits;
  for (const double one : drawn) logits.push_back(logit(one));
  const Spread spread = spread_of(logits);
  if (!spread.computable || !(spread.variance > 0.0)) return std::nullopt;
  const double off = 1.959963984540054 * std::sqrt(spread.variance);
  return Interval{1.0 / (1.0 + std::exp(off - logit(value))), 1.0 / (1.0 + std::exp(-off - logit(value)))};
}

void bootstrap_persons(Answer& answer, const Columns& columns, std::size_t resamples, std::uint64_t seed) {
  if (resamples == 0) return;
  const std::size_t persons = columns.front().size();
  const Bootstrapped drawn = percentile_bootstrap({&persons, 1}, resamples, seed, [&](const Draw& draw) {
    Columns drawn_columns(columns.size());
    for (std::size_t j = 0; j < columns.size(); ++j)
      for (const std::size_t person : draw.front()) drawn_columns[j].push_back(columns[j][person]);
    const std::optional<Omega> one = omega_of(drawn_columns);
    const bool inside = one && one->standardized > 0.0 && one->standardized < 1.0;
    return inside ? one->standardized : std::nan("");
  });
  if (drawn.values.size() * 4 >= drawn.draws * 3) answer.ci95 = logit_interval(*answer.estimate, drawn.values);
  if (drawn.without > 0)
    answer.notes.push_back("In " + std::to_string(drawn.without) + " of " + std::to_string(drawn.draws) +
                           " draws of persons no factor could be fitted" +
                           (answer.ci95 ? "." : ": there is no interval."));
  if (answer.ci95 && persons < kLargeEnough)
    answer.notes.emplace_back("Under 100 persons the interval may be too narrow.");
}

void say_fit(Answer& answer, const OneFactor& factor) {
  const double n = static_cast<double>(answer.n), p = static_cast<double>(factor.loadings.size());
  const double df = ((p - 1.0) * (p - 1.0) - (p + 1.0)) / 2.0;
  if (df > 0.0) {
    answer.statistic = (n - 1.0 - (2.0 * p + 5.0) / 6.0 - 2.0 / 3.0) * factor.chi_squared_per_n;
    if (*answer.statistic < 0.0) {
      answer.statistic.reset();
    } else {
      answer.df = {df};
      answer.p_value = chi_squared_upper(*answer.statistic, df);
      if (*answer.p_value < 0.05)
        answer.notes.emplace_back("One factor does not explain these items: omega of one factor says too little.");
    }
  }
  if (factor.at_bound)
    answer.notes.emplace_back("An item is almost the factor itself (Heywood case): do not rely on the loadings.");
}

}  // namespace

Answer omega(CompleteTable items, const ItemScale& scale, std::size_t resamples, std::uint64_t seed) {
  if (const char* reason = smaller_than(items, 4, 3))
    return refused_table("omega", reason, items, "One factor needs three items and four persons.");
  if (const std::string wrong = turn_items(items, scale); !wrong.empty())
    return refused_table("omega", "bad_value", items, wrong.c_str());
  const std::vector<std::string> constant = drop_constant_items(items);
  if (items.columns.size() < 3)
    return refused_table("omega", "no_variation", items, said_of_constant_items(constant).c_str());
  Columns columns;
  for (std::size_t j = 0; j < items.columns.size(); ++j) columns.push_back(items.column(j));
  const std::optional<Omega> found = omega_of(columns);
  if (!found)
    return refused_table(
        "omega", "no_convergence", items,
        "No factor can be fitted: items determine each other, or there are too few persons for them.");
  Answer answer;
  answer.test = "omega";
  answer.method = "McDonald's omega total of standardised items, one factor by maximum likelihood";
  if (resamples > 0) answer.method += "; interval on the logit scale by a bootstrap over persons";
  answer.n = items.rows;
  answer.missing = items.missing;
  answer.estimate = found->standardized;
  answer.estimate_name = "omega total";
  answer.more = {{"items", static_cast<double>(items.columns.size())}, {"omega_as_scored", found->as_scored}};
  for (std::size_t j = 0; j < items.columns.size(); ++j)
    answer.rows.push_back(
        {items.columns[j],
         {{"loading", found->factor.loadings[j]}, {"uniqueness", found->factor.uniquenesses[j]}}});
  say_fit(answer, found->factor);
  bootstrap_persons(answer, columns, resamples, seed);
  if (!constant.empty()) answer.notes.push_back(said_of_constant_items(constant));
  if (items.missing > 0) answer.notes.emplace_back("Persons who left an item out are left out.");
  return settled(std::move(answer));
}

}  // namespace seldinger::assessment::statistics
