// Which stored attempt shows how a case is done: what a trainee watches before an own attempt (docs/clinical.md,
// "First hour").
#pragma once

#include <optional>
#include <string>

#include "casedb/attempts/attempts.h"
#include "casedb/database/library.h"
#include "casedb/people/people.h"

namespace seldinger::casedb {

// The newest attempt that passed the case with its own guidance, approach and kind of needle, by the simulated
// expert or by somebody who was a consultant when it began and whose recording the reader may see
// (see_expert_replay). Nothing: there is none, or no such case. Whoever shows a simulated one says so
// (AttemptHead::synthetic).
std::optional<std::string> expert_replay_of(Library& library, const std::string& case_id,
                                            const std::string& reader_id, Role role);

}  // namespace seldinger::casedb
