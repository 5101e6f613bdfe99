// Operators side by side: passes, criteria and metrics in columns, what each attempt was told beneath.
#pragma once

#include <string>
#include <string_view>

#include "casedb/grading/comparison.h"

namespace seldinger::reports {

// A file of its own, with its style sheet inside. People are named by pseudonym.
std::string compare_page(const casedb::Comparison& comparison, std::string_view style);

std::string group_label(const casedb::ComparedGroup& group);  // "Person 3f20ab", "Simulated expert"

// "12 mm (9–14 mm)"; "2 of 5" of a yes and no; an em dash without a value.
std::string compared_text(const casedb::ComparedMetric& metric, std::string_view unit);

// By the metric's estimand: "12 mm (9–14 mm), 2 without success"; "worse than any value, 3 without success" where
// most neither fired nor deferred; "2 of 5" of a yes and no, who did neither among the 5; an em dash without a
// value.
std::string estimate_text(const casedb::ComparedMetric& metric, const assessment::MetricInfo& info);

}  // namespace seldinger::reports
