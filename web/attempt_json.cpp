#include "web/attempt_json.h"

#include "casedb/database/values_json.h"
#include "casedb/json/grading_json.h"

namespace seldinger::web {

std::string metrics_json(const casedb::AttemptRow& row) {
  return casedb::line({{"attempt_id", row.attempt_id},
                       {"synthetic", row.synthetic()},
                       {"metrics", casedb::json_of_metrics(row.metrics)}});
}

std::string grade_json(const casedb::AttemptRow& row, const casedb::AttemptGrade& grade,
                       bool with_expert_attempts) {
  nlohmann::ordered_json json = {{"attempt_id", row.attempt_id}};
  casedb::add_grade(grade, json);
  json["experts"] = casedb::json_of_experts(grade.experts);
  if (!with_expert_attempts && json["experts"].is_object()) json["experts"].erase("attempts");
  return casedb::line(json);
}

std::string health_json(casedb::Health health, const std::string& program_version) {
  return casedb::line({{"status", casedb::name_of(health)}, {"version", program_version}});
}

}  // namespace seldinger::web
