// Who is behind a command: the one door of every command that changes a library, decides, or hands something out
// (docs/decisions/0046). The options of a command that `acts` are in app/cli/command.h.
#pragma once

#include <sys/types.h>
#include <unistd.h>

#include <optional>
#include <string>

#include "app/cli/command.h"
#include "casedb/cases/permissions.h"
#include "casedb/database/audit.h"

namespace seldinger::app {

inline constexpr Option kWhose{"--user", "NAME", "whose account"};

enum class WhereNone { refuse, create };

// Opens the command's library (app/cli/library_place.h) to look into; what was called by title or beginning in its
// arguments is an id after that (app/acting/names.h). Refused as Library::open, and `ambiguous`.
base::Result<casedb::Library> open_library(const Arguments& arguments);

// The same to act in; it then acts for the person of --by who has given their password or has a session, else for
// the operator: the operating system's account `uid` that owns the library, or root. Refused as open_library, and
// `bad_log_in`, `too_many_tries`, `no_session`, `bad_token_file`, `not_proven` (neither proof nor owner).
base::Result<casedb::Library> open_acting(const Arguments& arguments, WhereNone where_none = WhereNone::refuse,
                                          uid_t uid = ::geteuid());

// The person in whose name the command acts, when their role may; none for the operator in nobody's name, who may.
// `no_user`, `not_allowed` (kept in the audit log).
base::Result<std::optional<std::string>> acting(casedb::Library& library, const Arguments& arguments,
                                                casedb::Action action, const casedb::Subject& subject = {});
// The same, of what is somebody's: `person_id`'s.
base::Result<std::optional<std::string>> acting_on(casedb::Library& library, const Arguments& arguments,
                                                   casedb::Action action,
                                                   const std::optional<std::string>& person_id);

// `work_on_case`, of the command's first word; of no case: nothing is refused here.
base::Result<std::optional<std::string>> may_work_on(casedb::Library& library, const Arguments& arguments);

// As refuse(); that the role may not is kept in the audit log.
int refuse_act(casedb::Library& library, casedb::Act act, const base::Error& error);

}  // namespace seldinger::app
