// What a case must hold to be worth an attempt, as it was found. Who looks is the program
// (session/case/case_check.h), and what was found is publish_case's way in (casedb/cases/versions.h).
#pragma once

#include <algorithm>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <vector>

#include "sim/base/result.h"

namespace seldinger::casedb {

class Library;

struct Check {
  std::string name;  // stable snake_case: lesion_inside_body
  bool holds = false;
  std::string text;                          // what was found, or why it does not hold
  std::optional<glm::dvec3> place_lps_mm{};  // where to look, if there is such a place
};

struct CaseCheck {
  std::vector<Check> checks;
  std::vector<std::string> rule_may_name;  // ids of metrics that can have a value at this case
  // casedb::content_mark of the case, taken before it was looked at. Without it nothing is published.
  std::string content_mark{};
  bool holds() const {
    return std::all_of(checks.begin(), checks.end(), [](const Check& one) { return one.holds; });
  }
};

// `checks_failed` with every check that does not hold; what publish_case answers then.
base::Result<void> ready_to_publish(const CaseCheck& check);

// Tells whether a case is as it was: another mark after each change of what its check looks at, whoever made it.
// Title and state, attempts and decisions change nothing.
std::string content_mark(Library& library, const std::string& case_id);

}  // namespace seldinger::casedb
