// Who may see what. Deny by default; cohorts and studies do not exist yet, so a mentor and a researcher see all.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "casedb/curriculum.h"
#include "casedb/store.h"

namespace seldinger::web {

enum class AttemptScope { none, own, all };

// Which attempts a role sees: trainee own; mentor and researcher all; director and admin none.
AttemptScope attempt_scope(casedb::Role role) noexcept;

bool may_see_attempt(const casedb::Account& reader, const casedb::AttemptRow& row);

// Which cases a role reads: a mentor all, a director all but drafts, researcher and admin what is or was published;
// a trainee attempts cases and reads none (what is right would be told).
bool may_see_case(casedb::Role role, const casedb::CaseRow& row) noexcept;

// Which curricula a role reads: a mentor, who makes them, and a director, who publishes them, all; a researcher
// what is or was published; a trainee what is published, with their own states; an admin none.
bool may_see_curriculum(casedb::Role role, const casedb::Curriculum& curriculum) noexcept;

// Whether a role reads which attempts set a standard: who sees them all.
bool may_see_experts(casedb::Role role) noexcept;

// How the operator is called for this reader: the log-in name, except that a researcher reads a pseudonym.
// `account_of` answers none for a person whose account is gone.
using AccountOf = std::function<std::optional<casedb::Account>(const std::string& person_id)>;
std::string operator_label(const casedb::Account& reader, const casedb::AttemptRow& row,
                           const AccountOf& account_of);

}  // namespace seldinger::web
