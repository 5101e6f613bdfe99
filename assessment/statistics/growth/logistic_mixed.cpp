#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include "assessment/statistics/distributions.h"
#include "assessment/statistics/growth/logistic_fit.h"
#include "assessment/statistics/growth/mixed_model.h"
#include "assessment/statistics/growth/person_rows.h"
#include "assessment/statistics/growth/repeated_persons.h"

namespace seldinger::assessment::statistics {
namespace {

constexpr const char* kLogistic = "logistic_mixed";
constexpr double kMostRows = 200'000;

// Of the effect in the units given: log odds, standard error.
std::pair<double, double> effect_of(const LogisticFit& fit, const std::vector<double>& weights) {
  double value = 0.0, variance = 0.0;
  for (std::size_t i = 0; i < weights.size(); ++i) {
    value += weights[i] * fit.beta[i];
    for (std::size_t j = 0; j < weights.size(); ++j) variance += weights[i] * weights[j] * fit.covariance[i][j];
  }
  return {value, std::sqrt(variance)};
}

void add_log_odds(Answer& answer, const LogisticFit& fit, const FixedEffects& fixed) {
  const double z975 = normal_quantile_of(0.975);
  for (std::size_t k = 0; k < fixed.names.size(); ++k) {
    const auto [value, se] = effect_of(fit, fixed.weights[k]);
    const double z = value / se;
    answer.rows.push_back({fixed.names[k],
                           {{"estimate", value},
                            {"se", se},
                            {"z", z},
                            {"p", 2.0 * normal_upper(std::abs(z))},
                            {"low", value - z975 * se},
                            {"high", value + z975 * se},
                            {"odds_ratio", std::exp(value)}}});
  }
}

Answer no_fit(const PersonRows& rows, LogisticFailure failure) {
  if (failure == LogisticFailure::separated)
    return no_repeated_persons(kLogistic, rows, "perfect_separation",
                               "Passes and failures are fully determined by persons, groups or x.");
  return no_repeated_persons(kLogistic, rows, "no_convergence", "No maximum of the likelihood was found.");
}

}  // namespace

Answer logistic_mixed(const DataTable& table, const LogisticMixedOptions& options) {
  const PersonRows rows = person_rows(table);
  if (std::any_of(rows.y.begin(), rows.y.end(), [](double y) { return y != 0.0 && y != 1.0; }))
    return no_repeated_persons(kLogistic, rows, "bad_value", "A value is neither 0 nor 1 (passed).");
  if (const auto no = unfit_for_model(kLogistic, rows)) return *no;
  if (std::all_of(rows.y.begin(), rows.y.end(), [&](double y) { return y == rows.y.front(); }))
    return no_repeated_persons(kLogistic, rows, "no_variation", "All passed, or nobody did.");
  if (static_cast<double>(rows.rows()) > kMostRows)
    return no_repeated_persons(kLogistic, rows, "too_many", "There may be 200,000 values.");
  const FixedEffects fixed = fixed_effects(rows, options.interaction);
  if (!told_apart(fixed))
    return no_repeated_persons(kLogistic, rows, "no_convergence", "An effect follows from the others.");
  const LogisticOutcome outcome =
      fit_logistic({rows.y, fixed.matrix, rows.person, fixed.columns, rows.persons}, options.nodes);
  if (outcome.failure != LogisticFailure::none) return no_fit(rows, outcome.failure);
  const LogisticFit& fit = outcome.fit;
  Answer answer = of_repeated_persons(kLogistic, rows);
  answer.method = "logistic mixed model, random intercept per person, adaptive Gauss–Hermite quadrature with " +
                  std::to_string(options.nodes) + " nodes, Wald";
  const double latent = fit.sd * fit.sd;
  answer.more = {{"values", static_cast<double>(rows.rows())},
                 {"log_likelihood", fit.log_likelihood},
                 {"sd_intercept", fit.sd},
                 {"icc_latent", latent / (latent + std::numbers::pi * std::numbers::pi / 3.0)}};
  add_log_odds(answer, fit, fixed);
  const std::size_t k = rows.x.empty() && rows.groups.size() != 2 ? 0 : 1;
  const std::vector<Named>& values = answer.rows[k].values;
  answer.estimate = values[0].value;
  answer.estimate_name = "log odds: " + effect_name(fixed, rows, k);
  answer.statistic = values[2].value;
  answer.p_value = values[3].value;
  answer.ci95 = Interval{values[4].value, values[5].value};
  if (fit.sd == 0.0) answer.notes.emplace_back("The fit is singular: persons differ no more than by chance.");
  return settled(std::move(answer));
}

}  // namespace seldinger::assessment::statistics
