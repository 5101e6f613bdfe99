#include "app/attempts/course_json.h"

#include "casedb/attempts/condition_table.h"

namespace seldinger::app {

using Json = nlohmann::ordered_json;

Json json_of_steps(const std::vector<assessment::StepResult>& steps) {
  Json list = Json::array();
  for (const assessment::StepResult& step : steps)
    list.push_back({{"id", step.id},
                    {"version", step.version},
                    {"state", assessment::name_of(step.state)},
                    {"t_s", step.t_s ? Json(*step.t_s) : Json(nullptr)},
                    {"reason", step.reason},
                    {"how", step.how ? Json(assessment::name_of(*step.how)) : Json(nullptr)}});
  return list;
}

Json json_of_conditions(const casedb::Conditions& conditions) {
  Json json = Json::object();
  for (const casedb::ConditionRow& row : casedb::condition_rows()) {
    const casedb::ConditionValue value = row.read(conditions);
    Json& cell = json[row.id] = nullptr;
    if (const bool* flag = std::get_if<bool>(&value)) cell = *flag;
    if (const std::string* words = std::get_if<std::string>(&value)) cell = *words;
    if (const double* number = std::get_if<double>(&value))
      cell = row.kind == casedb::ConditionKind::whole ? Json(static_cast<std::int64_t>(*number)) : Json(*number);
  }
  return json;
}

Json json_of_events(const std::optional<std::vector<cases::Event>>& events) {
  if (!events) return nullptr;
  Json list = Json::array();
  for (const cases::Event& event : *events) {
    const cases::EventInfo* info = cases::find_event(event.kind);
    if (info == nullptr) continue;
    list.push_back({{"t_s", event.t_s}, {"kind", info->name}, {"source", cases::name_of(info->source)}});
    if (event.kind == cases::EventKind::paused) list.back()["wall_s"] = event.wall_s;
    if (const auto length_mm = event.length_mm()) list.back()["length_mm"] = *length_mm;
  }
  return list;
}

}  // namespace seldinger::app
