// A pass rule as JSON: {"criteria": [{"metric": "hit", "version": 1, "comparison": ">=", "value": 1, "critical":
// false}]}.
#pragma once

#include <string>

#include "assessment/grading/rule.h"

namespace seldinger::assessment {

std::string json_of_rule(const PassRule& rule);  // one line

// `critical` may be left out, and `version`: then the one in force at a case of that law is meant. Refused:
// `bad_rule`, all problems as findings; whether there is such a metric is not asked.
base::Result<PassRule> rule_from_json(const std::string& text, cases::SightLaw law = cases::kNewestSightLaw);

}  // namespace seldinger::assessment
