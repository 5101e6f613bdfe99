// Which of an attempt's metrics a reader is shown, and which are named apart as what the case does not measure.
#pragma once

#include <string_view>
#include <vector>

#include "casedb/attempts/attempts.h"

namespace seldinger::reports {

// Of this group (metric_words.h), in stored order: what means something in the attempt's manner and is measured in
// its case. A null for what was done or left undone is among them.
std::vector<const casedb::MetricValue*> shown_metrics(const casedb::AttemptRow& row, std::string_view group);

// Of any group: what the case or the desk does not have, so that nothing could be measured whatever was done.
std::vector<const casedb::MetricValue*> absent_metrics(const casedb::AttemptRow& row);

}  // namespace seldinger::reports
