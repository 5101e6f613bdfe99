#include "casedb/attempts/attempt_history.h"

#include "casedb/attempts/attempt_columns.h"
#include "casedb/database/question.h"

namespace seldinger::casedb {

std::vector<AttemptKey> list_attempt_keys(Library& library) {
  std::vector<AttemptKey> keys;
  for (Statement rows = question(library.database(), "attempt_keys"); rows.step();) {
    keys.push_back({rows.text("attempt_id"), rows.text("case_id"), std::nullopt, rows.integer("started_us"),
                    rows.integer("synthetic") != 0, false});
    keys.back().of_simulated_person = !rows.is_null("of_simulated") && rows.integer("of_simulated") != 0;
    if (!rows.is_null("person_id")) keys.back().person_id = rows.text("person_id");
  }
  return keys;
}

std::vector<MetricValue> list_metric_versions(Library& library, const std::string& attempt_id) {
  std::vector<MetricValue> values;
  Statement rows = question(library.database(), "metric_values_of_attempt");
  for (rows.bind("attempt_id", attempt_id); rows.step();) values.push_back(read_metric(rows));
  return values;
}

}  // namespace seldinger::casedb
