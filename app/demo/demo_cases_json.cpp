#include <nlohmann/json.hpp>

#include "app/demo/demo_cases.h"

namespace seldinger::app {

namespace {

using Json = nlohmann::ordered_json;

Json json_of(const DemoCaseAnswer& one, const Json& number) {
  Json attempt = nullptr;
  if (!one.attempt_id.empty())
    attempt = {{"attempt_id", one.attempt_id}, {"operator", "expert"}, {"synthetic", true}, {"seed", one.seed}};
  Json warnings = Json::array();
  for (const base::Problem& warning : one.warnings)
    warnings.push_back({{"code", warning.code}, {"text", warning.text}});
  return {{"number", number},
          {"title", one.title},
          {"case_id", one.case_id},
          {"state", casedb::name_of(one.state)},
          {"decision", one.defer ? "defer" : "proceed"},
          {"hit", attempt},
          {"warnings", warnings}};
}

}  // namespace

std::string json_of_demo_cases(const DemoCasesAnswer& answer) {
  Json drills = Json::array(), cases = Json::array(), access = Json::array(), curricula = Json::array(),
       accounts = Json::array();
  for (const DemoCaseAnswer& one : answer.drills)
    drills.push_back(json_of(one, std::string("D").append(std::to_string(one.number))));
  for (const DemoCaseAnswer& one : answer.cases) cases.push_back(json_of(one, one.number));
  for (const DemoCaseAnswer& one : answer.access)
    access.push_back(json_of(one, std::string("A").append(std::to_string(one.number))));
  for (const DemoCurriculum& one : answer.curricula)
    curricula.push_back({{"title", one.title}, {"curriculum_id", one.curriculum_id}, {"items", one.items}});
  Json left_out = Json::array();
  for (const base::Error& one : answer.left_out) left_out.push_back({{"code", one.code}, {"text", one.text}});
  for (const auto& [name, password] : answer.passwords)
    accounts.push_back({{"name", name}, {"password", password}});
  return Json{{"drills", drills},       {"cases", cases},       {"access", access},
              {"curricula", curricula}, {"left_out", left_out}, {"accounts", accounts}}
             .dump(2) +
         "\n";
}

}  // namespace seldinger::app
