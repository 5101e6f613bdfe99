// The round of a command's first word, for somebody who may read what was said in it.
#pragma once

#include <cstddef>

#include "app/acting/acting.h"
#include "casedb/questionnaires/rounds.h"

namespace seldinger::app {

// Refused as acting (before it is told whether there is such a round), and find_round.
base::Result<casedb::Round> round_to_read(casedb::Library& library, const Arguments& arguments);

// Kept in the audit log, and of a planned study as a look at so many. `blinded`: nobody who works on a study whose
// plan is a draft gets answers by group.
base::Result<void> note_export(casedb::Library& library, const casedb::Round& round, std::size_t count);

}  // namespace seldinger::app
