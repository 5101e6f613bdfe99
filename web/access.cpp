#include "web/access.h"

#include <algorithm>

#include "reports/words/attempt_words.h"

namespace seldinger::web {

using casedb::Action;
using casedb::may;

casedb::Relation relation_to(const Relations& relations, const std::optional<std::string>& person_id) {
  casedb::Relation relation;
  relation.nobodys = !person_id.has_value();
  if (relation.nobodys) return relation;
  const auto found = relations.find(*person_id);
  return found == relations.end() ? relation : found->second;
}

casedb::WhoseAttempts attempts_seen(casedb::Role role, const Relations& relations) {
  casedb::WhoseAttempts seen;
  seen.nobodys = may(role, Action::see_attempt, relation_to(relations, std::nullopt));
  for (const auto& [person_id, relation] : relations)
    if (may(role, Action::see_attempt, relation)) seen.people.push_back(person_id);
  std::sort(seen.people.begin(), seen.people.end());
  return seen;
}

bool may_see_attempt(casedb::Role role, const Relations& relations, const casedb::AttemptRow& row) {
  return may(role, Action::see_attempt, relation_to(relations, row.person_id));
}

bool may_see_case(casedb::Role role, const casedb::CaseRow& row) noexcept {
  return may(role, Action::see_case, row.state);
}

bool may_see_curriculum(casedb::Role role, const casedb::Curriculum& curriculum) noexcept {
  return may(role, Action::see_curriculum, curriculum.state);
}

bool may_see_experts(casedb::Role role) noexcept {
  return may(role, Action::see_standard_attempts);
}

std::string operator_label(casedb::Role role, const Relations& relations, const casedb::AttemptRow& row,
                           const AccountOf& account_of) {
  if (row.synthetic()) return reports::simulated_operator_text(row.operator_name);
  if (!row.person_id.has_value()) return "Unknown person";
  if (may(role, Action::see_operator_name, relation_to(relations, row.person_id))) {
    if (const auto account = account_of(*row.person_id); account.has_value()) return account->login_name;
  }
  return reports::person_text(*row.person_id);
}

}  // namespace seldinger::web
