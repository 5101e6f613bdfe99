// What the commands about questionnaires answer.
#pragma once

#include <string>
#include <vector>

#include "app/questionnaires/paper_csv.h"
#include "casedb/questionnaires/rounds.h"

namespace seldinger::app {

std::string json_of_form(const casedb::StoredForm& form);  // with the form itself
std::string json_of_questionnaires(const std::vector<casedb::StoredForm>& forms,
                                   const std::vector<casedb::Round>& rounds);
std::string json_of_round(const casedb::Round& round);
// {"stored": 0, "differences": [{"respondent","column","first","second"}]}
std::string json_of_entry(std::size_t stored, const std::vector<EntryDifference>& differences);

}  // namespace seldinger::app
