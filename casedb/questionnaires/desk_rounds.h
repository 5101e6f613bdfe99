// Rounds that are answered at the workstation by whoever is logged in: once each, after an attempt, as a draft that
// outlives the program. In a study's round a respondent is called by their pseudonym, as in the study's other
// exports; in one of no study a code is drawn, and nobody who reads the answers learns whose they are.
#pragma once

#include <string>
#include <vector>

#include "casedb/questionnaires/responses.h"
#include "sim/base/result.h"

namespace seldinger::casedb {

// What this person is to answer now, the oldest first: open, not sent by them yet, and they have made an attempt
// since it was opened; of a study, while their consent stands.
std::vector<Round> due_at_desk(Library& library, const std::string& person_id);

// The secret of their draft (responses.h): of the one that they began before, whose older secret opens nothing any
// more, or of a new one. `no_round`, `not_due`, and as begin_response.
base::Result<std::string> answer_at_desk(Library& library, const std::string& round_id,
                                         const std::string& person_id);

// A set of answers that are this person's, within a transaction of the caller's: as begin_set.
base::Result<BegunSet> begin_set_of(Library& library, const Round& round, const std::string& person_id,
                                    const std::string& group);

}  // namespace seldinger::casedb
