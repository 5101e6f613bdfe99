// Tries to log in as the audit log has them: what a command, which forgets when it ends, is held to, and whom an
// admin let in again.
#pragma once

#include <cstdint>
#include <string>

#include "casedb/people/people.h"

namespace seldinger::casedb {

// log_in for a command, one at a time in each library, as fast as LoginDelays lets tries follow one another. What
// counts are the operator's failures under that name in the last hour, since the person was in or was let in again;
// nothing that fails at the dashboard or a window. Refused: `too_many_tries`, `bad_log_in`. A library that cannot
// be written notes no tries and delays none.
base::Result<Account> log_in_by_command(Library& library, const std::string& name, const std::string& password);

// Whoever failed under that name may try again at once, wherever: commands, dashboard and windows ask. `no_user`.
base::Result<void> let_in_again(Library& library, const std::string& name);

// The number that the person's being let in again in the last hour has in the audit log; 0: they were not.
std::int64_t last_let_in_again(Library& library, const std::string& person_id);

}  // namespace seldinger::casedb
