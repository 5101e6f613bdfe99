#include "web/attempt_json.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "casedb/grading_json.h"

namespace seldinger::web {
namespace {
std::string dumped(const nlohmann::ordered_json& json) {
  return json.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}
}  // namespace

std::string metrics_json(const casedb::AttemptRow& row) {
  auto metrics = nlohmann::ordered_json::array();
  for (const casedb::MetricValue& metric : row.metrics) {
    const bool is_number = metric.value.has_value() && std::isfinite(*metric.value);
    const bool is_broken = metric.value.has_value() && !is_number;
    metrics.push_back({{"id", metric.id},
                       {"version", metric.version},
                       {"value", is_number ? nlohmann::ordered_json(*metric.value) : nlohmann::ordered_json()},
                       {"unit", metric.unit},
                       {"reason", is_broken               ? nlohmann::ordered_json("not_finite")
                                  : metric.reason.empty() ? nlohmann::ordered_json()
                                                          : nlohmann::ordered_json(metric.reason)}});
  }
  return dumped({{"attempt_id", row.attempt_id}, {"synthetic", row.synthetic()}, {"metrics", metrics}});
}

std::string grade_json(const casedb::AttemptRow& row, const casedb::AttemptGrade& grade,
                       bool with_expert_attempts) {
  nlohmann::ordered_json json = {{"attempt_id", row.attempt_id}};
  casedb::add_grade(grade, json);
  json["experts"] = casedb::json_of_experts(grade.experts);
  if (!with_expert_attempts && json["experts"].is_object()) json["experts"].erase("attempts");
  return dumped(json);
}

std::string health_json(const std::string& program_version) {
  return dumped({{"status", "ok"}, {"version", program_version}});
}

}  // namespace seldinger::web
