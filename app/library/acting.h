// Who is behind a command that the table of permissions knows.
#pragma once

#include <optional>
#include <string>

#include "app/cli/command.h"
#include "casedb/cases/permissions.h"

namespace seldinger::app {

inline constexpr Option kActing{"--by", "NAME",
                                "the account that decides; left out: whoever has the library's files"};

// The person of --by, when the account may; none without --by. `no_user`, `not_allowed`.
inline base::Result<std::optional<std::string>> acting(casedb::Library& library, const Arguments& arguments,
                                                       casedb::Action action, casedb::Subject subject = {}) {
  if (!arguments.has("--by")) return std::optional<std::string>();
  const auto account = casedb::account_that_may(library, arguments.text("--by"), action, subject);
  if (!account) return account.error();
  return std::optional(account->person_id);
}

}  // namespace seldinger::app
