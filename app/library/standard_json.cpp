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

std::string json_of_cut_id(const std::string& cut_id) {
  return casedb::text({{"cut_id", cut_id}});
}

std::string json_of_cuts(const std::vector<casedb::Cut>& cuts) {
  auto list = nlohmann::ordered_json::array();
  for (const casedb::Cut& one : cuts) {
    nlohmann::ordered_json interval = nullptr;
    if (one.interval) interval = {one.interval->low, one.interval->high};
    list.push_back(
        {{"cut_id", one.cut_id},
         {"metric", casedb::maybe(one.metric_id)},
         {"version", one.metric_id.empty() ? nlohmann::ordered_json(nullptr) : nlohmann::ordered_json(one.version)},
         {"higher_is_better", one.higher_is_better},
         {"method", one.method},
         {"options", one.options},
         {"value", one.value},
         {"ci95", std::move(interval)},
         {"n", one.n},
         {"words", one.words},
         {"proposed_by", one.proposed_by},
         {"proposed_us", one.proposed_us},
         {"frozen_by", casedb::maybe(one.frozen_by)},
         {"frozen_us", casedb::maybe(one.frozen_us)},
         {"data", one.data}});
  }
  return casedb::text({{"cuts", list}});
}

}  // namespace seldinger::app
