#include "app/statistics/answer_json.h"

#include <cmath>

#include "assessment/statistics/reasons.h"
#include "casedb/database/values_json.h"

namespace seldinger::app {
namespace {

using Json = nlohmann::ordered_json;
using assessment::statistics::Answer;
using assessment::statistics::Named;

void add(const std::vector<Named>& numbers, Json& json) {
  for (const Named& one : numbers) {
    CHECK(std::isfinite(one.value) && !json.contains(one.name));
    json[one.name] = one.value;
  }
}

Json degrees_of_freedom(const Answer& answer) {
  if (answer.df.empty()) return nullptr;
  return answer.df.size() == 1 ? Json(answer.df.front()) : Json(answer.df);
}

}  // namespace

std::string json_of_answer(const Answer& answer) {
  const auto* reason = assessment::statistics::find_reason(answer.reason.c_str());
  Json groups = Json::array(), rows = Json::array();
  for (const auto& group : answer.groups) groups.push_back({{"name", group.name}, {"n", group.n}});
  for (const auto& row : answer.rows) {
    Json json = {{"name", row.name}};
    add(row.values, json);
    rows.push_back(std::move(json));
  }
  Json interval = nullptr;
  if (answer.ci95) interval = {answer.ci95->low, answer.ci95->high};
  Json json = {{"test", answer.test},
               {"status", answer.estimable() ? "ok" : "not_estimable"},
               {"reason", casedb::maybe(answer.reason)},
               {"reason_words", reason == nullptr ? Json(nullptr) : Json(reason->words)},
               {"n", answer.n},
               {"missing", answer.missing},
               {"method", casedb::maybe(answer.method)},
               {"groups", std::move(groups)},
               {"statistic", casedb::maybe(answer.statistic)},
               {"df", degrees_of_freedom(answer)},
               {"p_value", casedb::maybe(answer.p_value)},
               {"estimate", casedb::maybe(answer.estimate)},
               {"estimate_name", casedb::maybe(answer.estimate_name)},
               {"ci95", std::move(interval)},
               {"notes", answer.notes},
               {"rows", std::move(rows)}};
  add(answer.more, json);
  return casedb::text(json);
}

}  // namespace seldinger::app
