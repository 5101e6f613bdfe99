#include "app/library/standard_json.h"

#include "casedb/database/values_json.h"
#include "casedb/json/grading_json.h"

namespace seldinger::app {

std::string json_of_standard_id(const std::string& standard_id) {
  return casedb::text({{"standard_id", standard_id}});
}

std::string json_of_standards(const std::vector<casedb::Standard>& standards) {
  auto list = nlohmann::ordered_json::array();
  for (const casedb::Standard& one : standards) {
    nlohmann::ordered_json json = {{"lesion_id", one.lesion_id},
                                   {"modality", one.modality},
                                   {"approach", one.approach},
                                   {"instrument", one.instrument},
                                   {"by_operator", one.by_operator}};
    json.update(casedb::json_of_experts(one.set));
    list.push_back(std::move(json));
  }
  return casedb::text({{"standards", list}});
}

}  // namespace seldinger::app
