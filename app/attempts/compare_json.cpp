#include "app/attempts/compare_json.h"

#include "assessment/registry.h"
#include "casedb/database/values_json.h"
#include "casedb/json/grading_json.h"

namespace seldinger::app {
namespace {

using Json = nlohmann::ordered_json;

Json json_of(const casedb::ComparedMetric& metric) {
  if (metric.n == 0) return {{"n", 0}, {"median", nullptr}, {"mean", nullptr}, {"low", nullptr}, {"high", nullptr}};
  return {{"n", metric.n},
          {"median", metric.median},
          {"mean", metric.mean},
          {"low", metric.low},
          {"high", metric.high}};
}

// What the group says by the metric's estimand.
void add_estimate(const assessment::MetricInfo& info, const assessment::OnePerson& one, Json& json) {
  json["scale"] = assessment::words(info.estimand.scale);
  json["aggregation"] = assessment::words(info.estimand.aggregation);
  json["without_endpoint"] = assessment::words(info.estimand.without_endpoint);
  json["failures"] = one.failures;
  json["censored"] = one.censored;
  json["estimate"] = one.estimate ? Json(*one.estimate) : Json(nullptr);
  json["estimate_is_worst"] = one.worst;
}

Json json_of(const casedb::ComparedGroup& group, const casedb::Comparison& comparison) {
  Json criteria = Json::array(), metrics = Json::array(), attempts = Json::array();
  for (std::size_t i = 0; i < comparison.criteria.size(); ++i) {
    const assessment::CriterionResult& one = comparison.criteria[i];
    Json json = json_of(group.of_criteria[i]);
    json["metric"] = one.criterion.metric;
    json["version"] = one.criterion.version;
    json["comparison"] = assessment::sign_of(one.criterion.comparison);
    json["limit"] = one.criterion.value;
    json["unit"] = one.unit;
    json["critical"] = one.criterion.critical;
    json["met"] = group.met[i];
    criteria.push_back(std::move(json));
  }
  for (std::size_t i = 0; i < comparison.metrics.size(); ++i) {
    Json json = json_of(group.of_metrics[i]);
    json["metric"] = comparison.metrics[i].id;
    json["version"] = comparison.metrics[i].version;
    json["unit"] = comparison.metrics[i].unit;
    add_estimate(comparison.metrics[i], group.of_metrics[i].one, json);
    metrics.push_back(std::move(json));
  }
  for (const casedb::ComparedAttempt& one : group.attempts) {
    Json json = {{"attempt_id", one.row.attempt_id}, {"seed", one.row.seed}};
    casedb::add_grade(one.grade, json);
    attempts.push_back(std::move(json));
  }
  return {{"simulated", !group.person_id.has_value()},
          {"operator", group.person_id ? Json(nullptr) : Json(group.operator_name)},
          {"person_id", group.person_id ? Json(*group.person_id) : Json(nullptr)},
          {"attempts", group.attempts.size()},
          {"not_performed", group.not_performed},
          {"gradable", group.gradable},
          {"passed", group.passed},
          {"with_critical_errors", group.with_critical_errors},
          {"criteria", criteria},
          {"metrics", metrics},
          {"graded", attempts}};
}

}  // namespace

std::string json_of_comparison(const casedb::Comparison& comparison) {
  Json groups = Json::array();
  for (const casedb::ComparedGroup& group : comparison.groups) groups.push_back(json_of(group, comparison));
  return casedb::text({{"case_id", comparison.row.case_id},
                       {"version", comparison.row.version},
                       {"lesion_id", comparison.lesion_id},
                       {"modality", casedb::name_of(comparison.manner.modality)},
                       {"approach", casedb::name_of(comparison.manner.approach)},
                       {"instrument", casedb::name_of(comparison.manner.instrument)},
                       {"provisional", comparison.provisional},
                       {"experts", casedb::json_of_experts(comparison.experts)},
                       {"other_tasks", comparison.other_tasks},
                       {"groups", groups}});
}

}  // namespace seldinger::app
