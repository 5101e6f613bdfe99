#include "web/json/case_json.h"

#include "casedb/database/values_json.h"

namespace seldinger::web {

std::string case_json(const casedb::CaseParts& parts) {
  auto lesions = nlohmann::ordered_json::array();
  for (const casedb::LesionRow& lesion : parts.lesions) lesions.push_back(casedb::json_of_lesion(lesion));
  nlohmann::ordered_json json = {{"case_id", parts.row.case_id},
                                 {"title", parts.row.title},
                                 {"state", casedb::name_of(parts.row.state)},
                                 {"modality", casedb::name_of(parts.row.modality)},
                                 {"patient_position", casedb::name_of(parts.row.position)},
                                 {"lesions", lesions}};
  casedb::add_authoring(parts, json);
  return casedb::line(json);
}

std::string checks_json(const std::string& case_id, const casedb::CaseCheck& check) {
  auto checks = nlohmann::ordered_json::array();
  for (const casedb::Check& one : check.checks)
    checks.push_back({{"check", one.name}, {"holds", one.holds}, {"text", one.text}});
  return casedb::line(
      {{"case_id", case_id}, {"holds", check.holds()}, {"checks", checks}, {"rule_may_name", check.rule_may_name}});
}

}  // namespace seldinger::web
