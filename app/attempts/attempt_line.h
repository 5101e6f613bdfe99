// An attempt on one line of a terminal.
#pragma once

#include <string>
#include <vector>

#include "assessment/grading/grade.h"
#include "assessment/metrics/metric.h"
#include "casedb/attempts/attempts.h"

namespace seldinger::app {

// "Not passed    hit 0    12.3 mm from the centre   48.2 s": verdict, and what it hit.
std::string outcome_text(assessment::Verdict verdict, const std::vector<assessment::MetricValue>& metrics);

// Who made it: "Simulated expert, seed 3"; of a person `name`, empty: one who is erased.
std::string maker_text(const casedb::AttemptHead& attempt, const std::string& name);

}  // namespace seldinger::app
