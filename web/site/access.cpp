#include "web/site/access.h"

#include <algorithm>

#include "casedb/cases/setting_table.h"
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

namespace {

constexpr std::int64_t kDayUs = 86'400'000'000;

std::int64_t day_of(std::int64_t time_us) noexcept {
  return time_us - (time_us % kDayUs + kDayUs) % kDayUs;
}

bool reads_all(casedb::Role role) noexcept {
  return may(role, Action::see_free_text);
}

}  // namespace

void withhold(casedb::Role role, casedb::AttemptRow& row) {
  if (reads_all(role)) return;
  row.case_title = reports::case_text(row.case_id);
  row.started_us = day_of(row.started_us);
  row.conditions.station.reset();
  if (row.synthetic()) row.operator_name = std::string(reports::own_or_known_operator(row.operator_name));
}

void withhold(casedb::Role role, casedb::CaseRow& row) {
  if (reads_all(role)) return;
  row.title = reports::case_text(row.case_id);
  for (const casedb::SettingRow& setting : casedb::kSettingRows)
    if (const auto* words = std::get_if<casedb::TextField>(&setting.field)) words->set(row, {});
}

void withhold(casedb::Role role, casedb::CaseParts& parts) {
  if (!may(role, Action::see_case_notes))
    for (casedb::Decision& one : parts.decisions) one.note.clear();
  withhold(role, parts.row);
  if (reads_all(role)) return;
  for (casedb::Decision& one : parts.decisions) one.decided_us = day_of(one.decided_us);
  for (casedb::StructureRow& one : parts.structures) one.name = cases::name_of(one.rule);
}

void withhold(casedb::Role role, casedb::ItemState& item) {
  if (!reads_all(role)) item.title = reports::case_text(item.case_id);
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
