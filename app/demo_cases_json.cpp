#include <nlohmann/json.hpp>

#include "app/demo_cases.h"

namespace seldinger::app {

std::string json_of_demo_cases(const std::vector<DemoCaseAnswer>& made, const std::vector<int>& not_made,
                               const std::vector<std::pair<std::string, std::string>>& passwords) {
  using Json = nlohmann::ordered_json;
  Json cases = Json::array(), accounts = Json::array();
  for (const DemoCaseAnswer& one : made) {
    Json attempt = nullptr;
    if (!one.attempt_id.empty())
      attempt = {{"attempt_id", one.attempt_id}, {"operator", "expert"}, {"seed", one.seed}};
    cases.push_back({{"number", one.number},
                     {"title", one.title},
                     {"case_id", one.case_id},
                     {"state", one.state},
                     {"decision", one.defer ? "defer" : "proceed"},
                     {"hit", attempt}});
  }
  for (const auto& [name, password] : passwords) accounts.push_back({{"name", name}, {"password", password}});
  return Json{{"cases", cases}, {"not_made", not_made}, {"accounts", accounts}}.dump(2) + "\n";
}

}  // namespace seldinger::app
