#include "app/population/population_json.h"

#include <nlohmann/json.hpp>

#include "casedb/database/values_json.h"

namespace seldinger::app {
namespace {

namespace population = assessment::population;
using Json = nlohmann::ordered_json;

Json number_or_null(const std::optional<double>& value) {
  return value ? Json(*value) : Json(nullptr);
}

Json ratio(double part, std::size_t of) {
  return of == 0 ? Json(nullptr) : Json(part / static_cast<double>(of));
}

Json level_json(const LevelAgreement& level) {
  const population::Agreement& one = level.agreement;
  Json metrics = Json::array();
  for (const population::MetricAgreement& metric : one.metrics)
    metrics.push_back({{"metric", metric.metric},
                       {"values", metric.values},
                       {"quantile_sd", metric.quantile_sd},
                       {"quantile_error_sd", metric.quantile_error_sd},
                       {"quantile_errors_beyond", metric.quantile_errors},
                       {"null_points", metric.null_points},
                       {"zero_points", metric.zero_points}});
  return {{"group", level.group},
          {"attempts", one.attempts},
          {"metrics", metrics},
          {"quantiles_off", one.off.quantiles},
          {"quantiles_off_without_fault", one.off_without_fault.quantiles},
          {"quantiles_off_without_fault_most", one.most_off_without_fault.quantiles},
          {"quantiles_beyond_chance", one.beyond_chance.quantiles},
          {"quantile_own_sd", one.quantile_own_sd},
          {"rank_correlation_own", one.rank_correlation_own},
          {"shares_off", one.off.shares},
          {"shares_off_without_fault", one.off_without_fault.shares},
          {"shares_off_without_fault_most", one.most_off_without_fault.shares},
          {"shares_beyond_chance", one.beyond_chance.shares},
          {"pairs", one.pairs},
          {"pairs_off", one.off.pairs},
          {"pairs_off_without_fault", one.off_without_fault.pairs},
          {"pairs_off_without_fault_most", one.most_off_without_fault.pairs},
          {"pairs_beyond_chance", one.beyond_chance.pairs},
          {"worst_rank_correlation", one.worst_rank_correlation},
          {"worst_pair", one.worst_pair}};
}

Json groups_json(const GroupsAgreement& groups) {
  Json metrics = Json::array();
  for (const population::EffectAgreement& one : groups.effects)
    metrics.push_back({{"metric", one.metric},
                       {"auc", one.area},
                       {"auc_error", one.area_error},
                       {"auc_drawn", one.area_drawn},
                       {"d", one.d},
                       {"d_error", one.d_error},
                       {"d_drawn", one.d_drawn},
                       {"paired_rank_correlation", one.pairs}});
  return {{"more", groups.more}, {"less", groups.less}, {"off", effects_off(groups)}, {"metrics", metrics}};
}

}  // namespace

std::string json_of_fit(const population::Surrogate& surrogate) {
  return casedb::text(Json{{"synthetic", true},
                           {"case_id", surrogate.mark().case_id},
                           {"attempts", surrogate.attempts().size()},
                           {"metrics", surrogate.mark().metrics.size()}});
}

std::string json_of_agreement(const SurrogateAgreement& agreement) {
  Json levels = Json::array(), groups = Json::array();
  for (const LevelAgreement& one : agreement.levels) levels.push_back(level_json(one));
  for (const GroupsAgreement& one : agreement.effects) groups.push_back(groups_json(one));
  const Verdict verdict = verdict_of(agreement);
  return casedb::text(Json{{"synthetic", true},
                           {"levels", levels},
                           {"effects", groups},
                           {"comparisons", verdict.comparisons},
                           {"furthest_errors", verdict.furthest_errors},
                           {"allowed_errors", verdict.allowed_errors},
                           {"within_chance", verdict.within_chance()}});
}

std::string json_of_effects(const SimulatedEffects& effects) {
  Json metrics = Json::array(), published = Json::array();
  for (const SimulatedEffect& one : effects.metrics)
    metrics.push_back({{"metric", one.metric},
                       {"values", one.values},
                       {"d", number_or_null(one.difference)},
                       {"auc", number_or_null(one.area)},
                       {"novices", number_or_null(one.novices)},
                       {"practised", number_or_null(one.practised)},
                       {"experts", number_or_null(one.experts)}});
  for (const population::ReferenceEffect& row : population::reference_effects()) {
    const auto interval = population::interval95(row);
    Json people = nullptr;  // not reported
    if (row.n2 > 0)
      people = {row.n1, row.n2};
    else if (row.n1 > 0)
      people = {row.n1};
    const std::optional<double> unselected =
        row.selected ? std::optional(population::unselected(row.value, row.n1, row.n2)) : std::nullopt;
    const auto within = is_within(effects, row);
    published.push_back({{"source", row.source},
                         {"what", row.what},
                         {"kind", kind_text(row.kind)},
                         {"value", row.value},
                         {"standard_error", number_or_null(population::standard_error(row))},
                         {"ci95", interval ? Json{interval->low, interval->high} : Json(nullptr)},
                         {"people", people},
                         {"selected", row.selected},
                         {"unselected", number_or_null(unselected)},
                         {"fitted", row.fitted},
                         {"how", row.how},
                         {"simulated", number_or_null(predicted(effects, row))},
                         {"within", within ? Json(*within) : Json(nullptr)}});
  }
  return casedb::text(Json{{"synthetic", true},
                           {"case", effects.case_title},
                           {"people", effects.people},
                           {"practice_gain", effects.practice_gain},
                           {"metrics", metrics},
                           {"published", published}});
}

std::string json_of_distributions(const SimulatedDistributions& made) {
  Json metrics = Json::array();
  for (const MetricDistribution& metric : made.metrics) {
    Json levels = Json::array(), published = Json::array();
    for (const LevelDistribution& level : metric.levels) {
      const bool told = level.sorted.size() > 1;
      levels.push_back({{"level", level.level},
                        {"values", level.sorted.size()},
                        {"percentiles", told ? Json(level.quantiles) : Json(nullptr)},
                        {"mean", told ? Json(level.mean) : Json(nullptr)},
                        {"sd", told ? Json(level.sd) : Json(nullptr)}});
    }
    for (const BesidePublished& one : beside_published(metric)) {
      const auto spread = population::spread_of(*one.row);
      published.push_back({{"source", one.row->source},
                           {"group", one.row->group},
                           {"centre", population::words(one.row->centre)},
                           {"value", one.row->value},
                           {"spread", population::words(one.row->spread)},
                           {"spread_ends", spread ? Json{spread->low, spread->high} : Json(nullptr)},
                           {"n", one.row->n},
                           {"counted", one.row->counted},
                           {"how", one.row->how},
                           {"level", one.row->level},
                           {"simulated", one.simulated},
                           {"simulated_below", one.below},
                           {"within", one.within_spread ? Json(*one.within_spread) : Json(nullptr)}});
    }
    metrics.push_back(
        {{"metric", metric.metric}, {"unit", metric.unit}, {"levels", levels}, {"published", published}});
  }
  return casedb::text(Json{{"synthetic", true},
                           {"case", made.case_title},
                           {"people", made.people},
                           {"simulated_attempts", made.simulated_attempts},
                           {"percentiles", {5, 25, 50, 75, 95}},
                           {"metrics", metrics}});
}

std::string json_of_doses(const std::vector<population::MetricDose>& doses, const std::vector<double>& shifts,
                          const population::DoseOptions& options) {
  Json metrics = Json::array();
  for (const population::MetricDose& dose : doses) {
    Json responses = Json::array();
    for (std::size_t s = 0; s < shifts.size(); ++s) {
      const population::MetricResponse& one = dose.responses[s];
      responses.push_back({{"shift", shifts[s]},
                           {"auc", one.area},
                           {"intervals", one.intervals},
                           {"coverage", ratio(static_cast<double>(one.covered), one.intervals)},
                           {"mean_width", one.mean_width},
                           {"d", number_or_null(one.d)},
                           {"d_of_logarithms", one.d && one.of_logarithms},
                           {"d_intervals", one.d_intervals},
                           {"d_coverage", ratio(static_cast<double>(one.d_covered), one.d_intervals)},
                           {"paired_rank_correlation", one.paired}});
    }
    metrics.push_back({{"metric", dose.metric}, {"responses", responses}});
  }
  return casedb::text(Json{{"synthetic", true},
                           {"studies", options.studies},
                           {"per_group", options.per_group},
                           {"truth_people", options.truth_people},
                           {"metrics", metrics}});
}

std::string json_of_studies(const population::StudiesSum& sum, const population::World& world) {
  Json outcomes = Json::array();
  for (const population::OutcomeSum& one : sum.primary)
    outcomes.push_back({{"name", one.name},
                        {"analysed", one.analysed},
                        {"significant", one.significant},
                        {"estimate_name", one.estimate_name},
                        {"truth", number_or_null(one.truth)},
                        {"mean_estimate", ratio(one.sum_of_estimates, one.analysed)},
                        {"coverage", ratio(static_cast<double>(one.covered), one.with_interval)},
                        {"mean_width", ratio(one.sum_of_widths, one.with_interval)}});
  return casedb::text(
      Json{{"synthetic", true}, {"studies", sum.studies}, {"per_group", world.per_group}, {"primary", outcomes}});
}

}  // namespace seldinger::app
