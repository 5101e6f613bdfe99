// Paper questionnaires that two people have typed into two CSV files, each without seeing the other's.
#pragma once

#include <string>
#include <vector>

#include "casedb/questionnaires/responses.h"
#include "sim/base/result.h"

namespace seldinger::app {

// A line for each person: columns `respondent` and `version` (of the form, as it stands on the paper), `group`
// where the round has groups, `language` where it is not the first, and one for each item, by its id. An empty cell
// is missing, n/a not applicable. `bad_csv`: a column is missing, unknown or twice, a row is of another length or
// version, or somebody stands in it twice.
base::Result<std::vector<casedb::PaperForm>> paper_forms_in_csv(const std::string& text,
                                                                const assessment::questionnaire::Form& form);

struct EntryDifference {
  std::string respondent, column, first, second;
};
// What the two typed otherwise: an item, a group, or somebody who is in one of them alone. Values that are read
// alike (4 and 4.0) are alike.
std::vector<EntryDifference> entry_differences(const std::vector<casedb::PaperForm>& first,
                                               const std::vector<casedb::PaperForm>& second,
                                               const assessment::questionnaire::Form& form);

}  // namespace seldinger::app
