// Metrics and rules for the tests of grades.
#pragma once

#include <initializer_list>
#include <vector>

#include "assessment/grading/grade.h"
#include "sim/base/check.h"

namespace seldinger::assessment {

// What a recording without fault has; gap_share first.
inline std::vector<MetricValue> good_quality() {
  return {{"gap_share", 2, 0.0, "share", ""},
          {"sample_rate_p5", 1, 1000.0, "Hz", ""},
          {"tracking_jumps", 1, 0.0, "count", ""}};
}

inline PassRule rule_of(std::initializer_list<const char*> pass, std::initializer_list<const char*> critical) {
  PassRule rule;
  for (const bool is_critical : {false, true})
    for (const char* text : is_critical ? critical : pass) {
      auto criterion = criterion_from(text);
      CHECK(criterion.has_value());
      criterion->critical = is_critical;
      rule.criteria.push_back(*criterion);
    }
  return rule;
}

}  // namespace seldinger::assessment
