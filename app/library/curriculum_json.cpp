#include "app/library/curriculum_json.h"

#include "casedb/database/values_json.h"

namespace seldinger::app {
namespace {

using Json = nlohmann::ordered_json;
using casedb::maybe;
using casedb::text;

Json head_of(const casedb::Curriculum& curriculum) {
  return {{"curriculum_id", curriculum.curriculum_id},
          {"title", curriculum.title},
          {"state", casedb::name_of(curriculum.state)},
          {"made_us", curriculum.made_us},
          {"items", curriculum.items.size()}};
}

}  // namespace

std::string json_of_curriculum_id(const std::string& curriculum_id) {
  return text({{"curriculum_id", curriculum_id}});
}

std::string json_of_curriculum_item(int number) {
  return text({{"item", number}});
}

std::string json_of_curricula(const std::vector<casedb::Curriculum>& curricula) {
  Json list = Json::array();
  for (const casedb::Curriculum& one : curricula) list.push_back(head_of(one));
  return text({{"curricula", list}});
}

std::string json_of_curriculum(const casedb::Curriculum& curriculum, const std::vector<casedb::ItemState>& items,
                               bool of_somebody) {
  Json list = Json::array();
  for (std::size_t i = 0; i < items.size(); ++i) {
    const casedb::ItemState& item = items[i];
    Json gates = Json::array();
    for (const assessment::Gate& gate : curriculum.items[i].gates)
      gates.push_back({{"after", gate.after + 1}, {"reached", assessment::name_of(gate.reached)}});
    Json json = {{"item", i + 1},
                 {"title", item.title},
                 {"family_id", curriculum.items[i].family_id},
                 {"case_id", item.case_id.empty() ? Json(nullptr) : Json(item.case_id)},
                 {"version", item.case_id.empty() ? Json(nullptr) : Json(item.version)},
                 {"attempt_limit", maybe(curriculum.items[i].attempt_limit)},
                 {"gates", gates}};
    if (of_somebody) {
      json["state"] = assessment::name_of(item.progress.reached);
      json["open"] = item.progress.open;
      json["due"] = item.progress.due;
      json["attempts"] = item.attempts;
      json["passes"] = item.passes;
      json["attempts_left"] = maybe(item.progress.attempts_left);
    }
    list.push_back(std::move(json));
  }
  Json json = head_of(curriculum);
  json["items"] = list;
  return text(json);
}

}  // namespace seldinger::app
