// A grade, its score, its experts and its sentences as JSON, for the command line and the dashboard.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "casedb/grading/grading.h"

namespace seldinger::casedb {

// Adds `grade`, `score` and `debrief`.
void add_grade(const AttemptGrade& grade, nlohmann::ordered_json& json);

// The set by name, who and how many are in it, and its bands; null where nobody is.
nlohmann::ordered_json json_of_experts(const assessment::ExpertSet& experts);

}  // namespace seldinger::casedb
