// Who may see what on the dashboard, by the one table of who may do what (casedb/cases/permissions.h).
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "casedb/attempts/attempts.h"
#include "casedb/cases/cases.h"
#include "casedb/grading/curriculum.h"
#include "casedb/people/people.h"

namespace seldinger::web {

enum class AttemptScope { none, own, all };

// Which attempts a role sees.
AttemptScope attempt_scope(casedb::Role role) noexcept;

bool may_see_attempt(const casedb::Account& reader, const casedb::AttemptRow& row);

// Which cases a role reads. A trainee attempts cases and reads none: what is right would be told.
bool may_see_case(casedb::Role role, const casedb::CaseRow& row) noexcept;

// Which curricula a role reads; a trainee with how far they are.
bool may_see_curriculum(casedb::Role role, const casedb::Curriculum& curriculum) noexcept;

// Whether a role reads which attempts set a standard: who sees them all.
bool may_see_experts(casedb::Role role) noexcept;

// How the operator is called for this reader: the log-in name, except that a researcher reads a pseudonym.
// `account_of` answers none for a person whose account is gone.
using AccountOf = std::function<std::optional<casedb::Account>(const std::string& person_id)>;
std::string operator_label(const casedb::Account& reader, const casedb::AttemptRow& row,
                           const AccountOf& account_of);

}  // namespace seldinger::web
