// The steps of a procedure as an attempt did them: each with its mark and when, its name opening what it is.
#pragma once

#include <span>
#include <string_view>

#include "assessment/procedure/steps.h"
#include "reports/markup/html.h"

namespace seldinger::reports {

// A step's name that opens what it is, as metric_details does. `version`: of the result beside it, 0 for none.
// `words`: what is clicked on; empty: the step's own. An id that the table does not know stands as plain text.
Html step_details(std::string_view id, int version = 0, std::string_view words = {});

// Every step that was asked for with its mark, a legend of the marks, and apart what was not asked for and why.
Html step_section(std::span<const assessment::StepResult> steps);

}  // namespace seldinger::reports
