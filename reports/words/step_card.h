// What a step of a procedure is and what the mark before it says, for somebody who asks. From the tables of
// assessment/procedure alone; window, pages and commands show the same.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "assessment/procedure/steps.h"
#include "reports/words/card.h"

namespace seldinger::reports {

// What stands before a step, and what a legend says of it.
struct StepMark {
  const char* sign;     // "✓"
  const char* words;    // "said"
  bool told;            // in words behind the step, too: its sign has another meaning alone
  const char* meaning;  // "said in time; no action can show it"
};

const StepMark& step_mark(const assessment::StepResult& step);

// Of the steps that were asked for: each mark once, in the order of the table; a legend of them is whole.
std::vector<const StepMark*> step_legend(std::span<const assessment::StepResult> steps);

// As a checklist says it; an id that the table does not know gives its own words.
std::string step_label(std::string_view id);
// With what its mark tells: "Sign out (said)".
std::string step_text(const assessment::StepResult& step);
// "✓ shown at 12.3 s: your action showed it, in time"; of one that was not asked for, why.
std::string step_result_text(const assessment::StepResult& step);

// Of one that was done wrongly or too late, what happened then: "a pulse met the hand"; else empty.
std::string step_fault_text(const assessment::StepResult& step);

// `version`: of the result that is asked about, as metric_card has it.
Card step_card(std::string_view id, int version = 0);

}  // namespace seldinger::reports
