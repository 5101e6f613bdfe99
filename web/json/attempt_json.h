// An attempt's metrics and grade as JSON, in the form of the command line's `score`.
#pragma once

#include <string>

#include "casedb/grading/grading.h"
#include "casedb/keeping/health.h"

namespace seldinger::web {

std::string metrics_json(const casedb::AttemptRow& row);
std::string grade_json(const casedb::AttemptRow& row, const casedb::AttemptGrade& grade, bool with_experts);
std::string health_json(casedb::Health health, const std::string& program_version);

}  // namespace seldinger::web
