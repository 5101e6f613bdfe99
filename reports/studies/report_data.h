// The data of a validity report with a script for R that redoes its numbers: what a reviewer runs.
#pragma once

#include <string>
#include <vector>

#include "reports/studies/validity_report.h"

namespace seldinger::reports {

struct DataFile {
  std::string name, content;
};
// people.csv (what each person has on each outcome, by a number in the place of the pseudonym), outcomes.csv (how
// each is compared), answers.csv and ratings.csv (items of questionnaires, raters' scores), related.csv (outcomes
// beside mean ratings and stated experience), subgroups.csv (who passed, by subgroup), baseline.csv (what groups
// stated), imputed.csv (what was drawn), numbers.csv (what the report says, with all digits) and redo.R, which
// tells each number that it finds otherwise. Of a frozen plan.
std::vector<DataFile> report_data(const ValidityReport& report);

}  // namespace seldinger::reports
