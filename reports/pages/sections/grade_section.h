// What a trainee reads first of an attempt: whether it passed, three sentences, and the criteria one by one.
#pragma once

#include "casedb/grading/grading.h"
#include "reports/markup/html.h"

namespace seldinger::reports {

Html grade_section(const casedb::AttemptGrade& grade);

// Just the sentences, as a list.
Html debrief_list(const std::vector<assessment::Sentence>& sentences);

}  // namespace seldinger::reports
