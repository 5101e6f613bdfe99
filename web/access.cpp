#include "web/access.h"

#include "casedb/cases/permissions.h"
#include "reports/words/attempt_words.h"

namespace seldinger::web {

using casedb::Action;
using casedb::may;
using casedb::Subject;

AttemptScope attempt_scope(casedb::Role role) noexcept {
  if (may(role, Action::see_attempt, Subject::whose(false))) return AttemptScope::all;
  return may(role, Action::see_attempt, Subject::whose(true)) ? AttemptScope::own : AttemptScope::none;
}

bool may_see_attempt(const casedb::Account& reader, const casedb::AttemptRow& row) {
  return may(reader.role, Action::see_attempt, Subject::whose(row.person_id == reader.person_id));
}

bool may_see_case(casedb::Role role, const casedb::CaseRow& row) noexcept {
  return may(role, Action::see_case, row.state);
}

bool may_see_curriculum(casedb::Role role, const casedb::Curriculum& curriculum) noexcept {
  return may(role, Action::see_curriculum, curriculum.state);
}

bool may_see_experts(casedb::Role role) noexcept {
  return attempt_scope(role) == AttemptScope::all;
}

std::string operator_label(const casedb::Account& reader, const casedb::AttemptRow& row,
                           const AccountOf& account_of) {
  if (row.synthetic()) return reports::simulated_operator_text(row.operator_name);
  if (!row.person_id.has_value()) return "Unknown person";
  if (may(reader.role, Action::see_operator_name)) {
    if (const auto account = account_of(*row.person_id); account.has_value()) return account->login_name;
  }
  return reports::person_text(*row.person_id);
}

}  // namespace seldinger::web
