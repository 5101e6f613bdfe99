// A pass rule as JSON: {"criteria": [{"metric": "hit", "version": 1, "comparison": ">=", "value": 1, "critical":
// false}]}.
#pragma once

#include <string>

#include "assessment/grading/rule.h"

namespace seldinger::assessment {

std::string json_of_rule(const PassRule& rule);  // one line

// `version` and `critical` may be left out. Refused: `bad_rule`, all problems as findings; ids are not looked up.
base::Result<PassRule> rule_from_json(const std::string& text);

}  // namespace seldinger::assessment
