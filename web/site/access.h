// Who may see what on the dashboard, by the one table of who may do what (casedb/cases/permissions.h).
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <unordered_map>

#include "casedb/attempts/attempts.h"
#include "casedb/cases/cases.h"
#include "casedb/cases/permissions.h"
#include "casedb/grading/learner_records.h"
#include "casedb/json/case_json.h"
#include "casedb/people/people.h"

namespace seldinger::web {

// What everybody is to the reader, by person id; who is not in it is nothing to them.
using Relations = std::unordered_map<std::string, casedb::Relation>;
casedb::Relation relation_to(const Relations& relations, const std::optional<std::string>& person_id);

// The attempts that a reader sees: by whose they are.
casedb::WhoseAttempts attempts_seen(casedb::Role role, const Relations& relations);
bool may_see_attempt(casedb::Role role, const Relations& relations, const casedb::AttemptRow& row);

// Which cases a role reads. A trainee attempts cases and reads none: what is right would be told.
bool may_see_case(casedb::Role role, const casedb::CaseRow& row) noexcept;

// Which curricula a role reads; a trainee with how far they are.
bool may_see_curriculum(casedb::Role role, const casedb::Curriculum& curriculum) noexcept;

// Whether a role reads which attempts set a standard.
bool may_see_experts(casedb::Role role) noexcept;

// Takes from it what this reader is not told: who may not read free text gets ids for titles, the case's kind for a
// structure's name, nothing for other words, and times cut to the day (UTC).
void withhold(casedb::Role role, casedb::AttemptRow& row);
void withhold(casedb::Role role, casedb::CaseRow& row);
void withhold(casedb::Role role, casedb::CaseParts& parts);
void withhold(casedb::Role role, casedb::ItemState& item);

// How the operator is called for this reader: the log-in name where it may be read, else a pseudonym. `account_of`
// answers none for a person whose account is gone.
using AccountOf = std::function<std::optional<casedb::Account>(const std::string& person_id)>;
std::string operator_label(casedb::Role role, const Relations& relations, const casedb::AttemptRow& row,
                           const AccountOf& account_of);

}  // namespace seldinger::web
