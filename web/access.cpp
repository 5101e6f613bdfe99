#include "web/access.h"

#include "reports/attempt_words.h"

namespace seldinger::web {

AttemptScope attempt_scope(casedb::Role role) noexcept {
  switch (role) {
    case casedb::Role::trainee:
      return AttemptScope::own;
    case casedb::Role::mentor:
    case casedb::Role::researcher:
      return AttemptScope::all;
    case casedb::Role::director:
    case casedb::Role::admin:
      return AttemptScope::none;
  }
  return AttemptScope::none;
}

bool may_see_attempt(const casedb::Account& reader, const casedb::AttemptRow& row) {
  switch (attempt_scope(reader.role)) {
    case AttemptScope::all:
      return true;
    case AttemptScope::own:
      return row.person_id.has_value() && *row.person_id == reader.person_id;
    case AttemptScope::none:
      return false;
  }
  return false;
}

bool may_see_case(casedb::Role role, const casedb::CaseRow& row) noexcept {
  switch (role) {
    case casedb::Role::mentor:
      return true;
    case casedb::Role::director:
      return row.state != casedb::CaseState::draft;
    case casedb::Role::researcher:
    case casedb::Role::admin:
      return row.state == casedb::CaseState::published || row.state == casedb::CaseState::retired;
    case casedb::Role::trainee:
      return false;
  }
  return false;
}

bool may_see_curriculum(casedb::Role role, const casedb::Curriculum& curriculum) noexcept {
  switch (role) {
    case casedb::Role::mentor:
    case casedb::Role::director:
      return true;
    case casedb::Role::researcher:
      return curriculum.state != casedb::CurriculumState::draft;
    case casedb::Role::trainee:
      return curriculum.state == casedb::CurriculumState::published;
    case casedb::Role::admin:
      return false;
  }
  return false;
}

bool may_see_experts(casedb::Role role) noexcept {
  return attempt_scope(role) == AttemptScope::all;
}

std::string operator_label(const casedb::Account& reader, const casedb::AttemptRow& row,
                           const AccountOf& account_of) {
  if (row.synthetic()) return reports::simulated_operator_text(row.operator_name);
  if (!row.person_id.has_value()) return "Unknown person";
  if (reader.role != casedb::Role::researcher) {
    if (const auto account = account_of(*row.person_id); account.has_value()) return account->login_name;
  }
  return reports::person_text(*row.person_id);
}

}  // namespace seldinger::web
