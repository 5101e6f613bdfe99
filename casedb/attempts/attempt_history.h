// Attempts for those who take them out of the library: all of them in little memory, and every value that was ever
// scored.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "casedb/attempts/attempts.h"
#include "casedb/database/library.h"

namespace seldinger::casedb {

struct AttemptKey {
  std::string attempt_id, case_id;
  std::optional<std::string> person_id;
  std::int64_t started_us = 0;
  bool synthetic = false;  // a simulated operator's, also in a person's name
  bool of_simulated_person = false;
};
std::vector<AttemptKey> list_attempt_keys(Library& library);  // oldest first

// Of every version, by id and version.
std::vector<MetricValue> list_metric_versions(Library& library, const std::string& attempt_id);

}  // namespace seldinger::casedb
