#include "app/case_answers_json.h"

#include <nlohmann/json.hpp>

namespace seldinger::app {
namespace {

using Json = nlohmann::ordered_json;

std::string text(const Json& json) {
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace

std::string json_of_structure(const std::string& structure_id) {
  return text({{"structure_id", structure_id}});
}

std::string json_of_labels(const std::vector<LabelCount>& labels, bool resampled) {
  Json list = Json::array();
  for (const LabelCount& one : labels)
    list.push_back({{"label", one.label}, {"name", one.name}, {"voxels", one.voxels}});
  return text({{"labels", list}, {"resampled", resampled}});
}

std::string json_of_checks(const std::string& case_id, const CaseCheck& check) {
  Json list = Json::array();
  for (const Check& one : check.checks)
    list.push_back({{"check", one.name}, {"holds", one.holds}, {"text", one.text}});
  return text(
      {{"case_id", case_id}, {"holds", check.holds()}, {"checks", list}, {"rule_may_name", check.rule_may_name}});
}

std::string json_of_version(const casedb::CaseRow& row) {
  return text(
      {{"case_id", row.case_id}, {"family_id", row.family_id}, {"version", row.version}, {"state", row.state}});
}

}  // namespace seldinger::app
