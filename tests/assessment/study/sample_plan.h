// A plan for tests: two groups by years, one primary outcome by order and one by means.
#pragma once

#include <string>

#include "assessment/registry.h"
#include "assessment/study/plan.h"

namespace seldinger::assessment::study {

inline std::string version_of(const char* metric) {
  return std::to_string(find_metric(metric)->version);
}

// `extra` stands among the plan's own fields: ", \"hands\": …".
inline std::string sample_plan_json(const std::string& extra = "", const std::string& groups = "") {
  const std::string claims =
      R"({"inference": "scoring", "claim": "c", "evidence": "e", "rebuttals": ["r"]},
         {"inference": "generalisation", "claim": "c", "rebuttals": ["r"]},
         {"inference": "extrapolation", "claim": "c", "rebuttals": ["r"]},
         {"inference": "implications", "claim": "c", "rebuttals": ["r"]})";
  const std::string by_years =
      R"("groups": [{"name": "few", "facts": [{"fact": "years_in_radiology", "comparison": "<=", "value": 1}]},
                    {"name": "many", "facts": [{"fact": "years_in_radiology", "comparison": ">=", "value": 5}]}])";
  return R"({"title": "t", "intended_use": "u", "decision": "d", "argument": [)" + claims + "], " +
         (groups.empty() ? by_years : groups) +
         R"(, "visits": [{"name": "v", "from_day": -10, "to_day": 10.5}],
    "primary": [{"name": "distance", "metric": "tip_target_dist", "version": )" +
         version_of("tip_target_dist") +
         R"(, "case": "case-1", "visit": "v", "test": "brunner_munzel", "compare": ["few", "many"],
                 "better": "lower", "smallest_worthwhile": 2},
                {"name": "no-go", "metric": "nogo_length", "version": )" +
         version_of("nogo_length") +
         R"(, "case": "case-1", "visit": "v", "test": "welch", "compare": ["few", "many"],
                 "better": "lower", "smallest_worthwhile": 0.5}],
    "stopping": {"per_group": 3, "rule": "r"}, "missing": {"absent": "left_out", "why": "w"})" +
         extra + "}";
}

inline Plan sample_plan(const std::string& extra = "", const std::string& groups = "") {
  return plan_from_json(sample_plan_json(extra, groups)).value();
}

inline const char* const kArms = R"("arms": [{"name": "few", "ratio": 2}, {"name": "many"}],
  "randomisation": {"strata": ["handedness"], "block_sizes": [3, 6]})";

}  // namespace seldinger::assessment::study
