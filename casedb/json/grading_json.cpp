#include "casedb/json/grading_json.h"

#include <algorithm>

#include "casedb/database/values_json.h"

namespace seldinger::casedb {
namespace {

using Json = nlohmann::ordered_json;

Json json_of(const assessment::CriterionResult& one) {
  return {{"metric", one.criterion.metric},
          {"version", one.criterion.version},
          {"comparison", assessment::sign_of(one.criterion.comparison)},
          {"limit", one.criterion.value},
          {"unit", one.unit},
          {"critical", one.criterion.critical},
          {"of_the_time_limit", one.of_the_time_limit},
          {"outcome", assessment::name_of(one.outcome)},
          {"value", maybe(one.value)},
          {"reason", maybe(one.reason)}};
}

Json json_of(const assessment::Score& score) {
  Json parts = Json::array();
  const double weight = 1.0 / static_cast<double>(std::max<std::size_t>(score.parts.size(), 1));
  for (const assessment::ScorePart& part : score.parts)
    parts.push_back({{"metric", part.id},
                     {"version", part.version},
                     {"unit", part.unit},
                     {"weight", weight},
                     {"value", maybe(part.value)},
                     {"mean", part.mean},
                     {"sd", part.sd},
                     {"least_sd", part.least_sd},
                     {"z", maybe(part.z)},
                     {"reason", maybe(part.reason)}});
  return {{"value", maybe(score.value)},
          {"reason", maybe(score.reason)},
          {"set_id", maybe(score.set_id)},
          {"formula", assessment::kScoreFormula},
          {"parts", parts}};
}

}  // namespace

void add_grade(const AttemptGrade& grade, Json& json) {
  Json criteria = Json::array(), sentences = Json::array();
  for (const assessment::CriterionResult& one : grade.grade.criteria) criteria.push_back(json_of(one));
  for (const assessment::Sentence& one : grade.debrief)
    sentences.push_back(
        {{"kind", assessment::name_of(one.kind)}, {"text", one.text}, {"metric", maybe(one.metric_id)}});
  json["grade"] = {{"verdict", assessment::name_of(grade.grade.verdict)},
                   {"reason", maybe(grade.grade.reason)},
                   {"provisional", grade.provisional},
                   {"critical_errors", grade.grade.critical_errors()},
                   {"criteria", criteria}};
  json["score"] = json_of(grade.score);
  json["debrief"] = sentences;
}

Json json_of_experts(const assessment::ExpertSet& experts) {
  if (experts.id.empty()) return nullptr;
  Json bands = Json::array();
  for (const assessment::MetricBand& band : experts.bands)
    bands.push_back(
        {{"metric", band.id},
         {"version", band.version},
         {"unit", band.unit},
         {"n", band.n},
         {"low", band.low},
         {"high", band.high},
         {"mean", band.mean},
         {"sd", band.sd},
         {"tolerance", band.tolerance ? Json{band.tolerance->low, band.tolerance->high} : Json(nullptr)}});
  return {{"kind", "consultants"},
          {"standard", experts.standard()},
          {"standard_id", maybe(experts.standard_id)},
          {"set_us", experts.standard() ? Json(experts.set_us) : Json(nullptr)},
          {"set_id", experts.id},
          {"people", experts.people},
          {"newest_us", experts.newest_us},
          {"attempts", experts.attempt_ids},
          {"bands", bands}};
}

}  // namespace seldinger::casedb
