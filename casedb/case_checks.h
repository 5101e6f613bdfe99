// What a case must hold to be worth an attempt, as it was found. Who looks is the program (app/case_check.h).
#pragma once

#include <algorithm>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <vector>

namespace seldinger::casedb {

struct Check {
  std::string name;  // stable snake_case: lesion_inside_body
  bool holds = false;
  std::string text;                          // what was found, or why it does not hold
  std::optional<glm::dvec3> place_lps_mm{};  // where to look, if there is such a place
};

struct CaseCheck {
  std::vector<Check> checks;
  std::vector<std::string> rule_may_name;  // ids of metrics that can have a value at this case
  bool holds() const {
    return std::all_of(checks.begin(), checks.end(), [](const Check& one) { return one.holds; });
  }
};

}  // namespace seldinger::casedb
