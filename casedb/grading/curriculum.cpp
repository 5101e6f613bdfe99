#include "casedb/grading/curriculum.h"

#include <algorithm>

#include "casedb/cases/permissions.h"
#include "casedb/database/audit.h"
#include "casedb/database/question.h"
#include "casedb/database/sqlite.h"
#include "casedb/database/uuid.h"
#include "casedb/people/cohorts.h"

namespace seldinger::casedb {
namespace {

constexpr int kMostAttempts = 1000;

Curriculum read_curriculum(Sqlite& database, const Statement& from) {
  Curriculum made;
  made.curriculum_id = from.text("curriculum_id");
  made.title = from.text("title");
  made.state = *curriculum_state_from(from.view("state"));  // the schema takes no others
  made.made_us = from.integer("made_us");
  Statement items = question(database, "curriculum_items");
  for (items.bind("curriculum_id", made.curriculum_id); items.step();) {
    CurriculumItem& item = made.items.emplace_back();
    item.family_id = items.text("family_id");
    if (!items.is_null("attempt_limit")) item.attempt_limit = items.small_integer("attempt_limit");
  }
  Statement gates = question(database, "curriculum_gates");
  for (gates.bind("curriculum_id", made.curriculum_id); gates.step();)
    made.items.at(static_cast<std::size_t>(gates.integer("position") - 1))
        .gates.push_back({static_cast<std::size_t>(gates.integer("after_position") - 1),
                          *assessment::proficiency_from(gates.text("reached"))});  // the schema takes no others
  return made;
}

void set_state(Sqlite& database, const std::string& curriculum_id, CurriculumState state,
               const std::string& person_id) {
  question(database, "set_curriculum_state")
      .bind("curriculum_id", curriculum_id)
      .bind("state", name_of(state))
      .bind("published_by", person_id)
      .bind("published_us", now_us())
      .run();
}

base::Error not_a_draft() {
  return {"not_a_draft", "a published curriculum is not changed: make another"};
}

}  // namespace

base::Result<std::string> add_curriculum(Library& library, const std::string& title, const std::string& by) {
  if (const auto fit = check_title(title); !fit) return fit.error();
  Transaction transaction(library.database());
  const auto account = account_that_may(library, by, Action::make_curriculum);
  if (!account) return account.error();
  std::string curriculum_id = new_uuid();
  question(library.database(), "add_curriculum")
      .bind("curriculum_id", curriculum_id)
      .bind("title", title)
      .bind("made_by", account->person_id)
      .bind("made_us", now_us())
      .run();
  audit(library, Act::make_curriculum, {"curriculum", curriculum_id});
  transaction.commit();
  return curriculum_id;
}

base::Result<int> add_curriculum_item(Library& library, const std::string& curriculum_id,
                                      const std::string& case_id, std::optional<int> attempt_limit,
                                      const std::vector<assessment::Gate>& gates, const std::string& by) {
  Transaction transaction(library.database());
  const auto account = account_that_may(library, by, Action::make_curriculum);
  if (!account) return account.error();
  const auto curriculum = find_curriculum(library, curriculum_id);
  if (!curriculum) return curriculum.error();
  if (curriculum->state != CurriculumState::draft) return not_a_draft();
  const auto row = find_case(library, case_id);
  if (!row) return row.error();
  if (row->state != CaseState::published) return base::Error{"not_published", "a curriculum holds published cases"};
  if (row->rule.criteria.empty()) return base::Error{"no_rule", "without a pass rule a case cannot be passed"};
  for (const CurriculumItem& item : curriculum->items)
    if (item.family_id == row->family_id)
      return base::Error{"case_taken", "the curriculum has an item of that case"};
  const std::size_t index = curriculum->items.size();
  if (attempt_limit && (*attempt_limit < 1 || *attempt_limit > kMostAttempts))
    return base::Error{"bad_item", "a limit is 1 to 1000 attempts"};
  for (std::size_t i = 0; i < gates.size(); ++i) {
    const bool twice = std::any_of(gates.begin(), gates.begin() + static_cast<std::ptrdiff_t>(i),
                                   [&](const assessment::Gate& other) { return other.after == gates[i].after; });
    if (gates[i].after >= index || twice || gates[i].reached < assessment::Proficiency::passed)
      return base::Error{"bad_item",
                         "a gate names an earlier item, once, and whether it must be passed or proficient"};
  }
  const int position = static_cast<int>(index) + 1;
  question(library.database(), "add_curriculum_item")
      .bind("curriculum_id", curriculum_id)
      .bind("position", position)
      .bind("family_id", row->family_id)
      .bind("attempt_limit",
            attempt_limit ? std::optional<std::int64_t>(*attempt_limit) : std::optional<std::int64_t>())
      .run();
  for (const assessment::Gate& gate : gates)
    question(library.database(), "add_curriculum_gate")
        .bind("curriculum_id", curriculum_id)
        .bind("position", position)
        .bind("after_position", static_cast<std::int64_t>(gate.after) + 1)
        .bind("reached", assessment::name_of(gate.reached))
        .run();
  audit(library, Act::change_curriculum, {"curriculum", curriculum_id});
  transaction.commit();
  return position;
}

base::Result<void> publish_curriculum(Library& library, const std::string& curriculum_id, const std::string& by) {
  Transaction transaction(library.database());
  const auto account = account_that_may(library, by, Action::release_curriculum);
  if (!account) return account.error();
  const auto curriculum = find_curriculum(library, curriculum_id);
  if (!curriculum) return curriculum.error();
  if (curriculum->state != CurriculumState::draft) return not_a_draft();
  if (curriculum->items.empty()) return base::Error{"no_items", "the curriculum has no item"};
  for (const CurriculumItem& item : curriculum->items) {
    const std::vector<FamilyVersion> versions = versions_of(library, item.family_id);
    if (std::none_of(versions.begin(), versions.end(),
                     [](const auto& one) { return one.state == CaseState::published; }))
      return base::Error{"not_published", "a case of the curriculum was retired since"};
  }
  set_state(library.database(), curriculum_id, CurriculumState::published, account->person_id);
  audit(library, Act::publish_curriculum, {"curriculum", curriculum_id});
  transaction.commit();
  return {};
}

base::Result<void> remove_curriculum(Library& library, const std::string& curriculum_id, const std::string& by) {
  Transaction transaction(library.database());
  const auto curriculum = find_curriculum(library, curriculum_id);
  if (!curriculum) return curriculum.error();
  if (curriculum->state == CurriculumState::retired)
    return base::Error{"bad_state", "the curriculum is retired already"};
  const bool draft = curriculum->state == CurriculumState::draft;
  const auto account =
      account_that_may(library, by, draft ? Action::remove_draft_curriculum : Action::retire_curriculum);
  if (!account) return account.error();
  if (draft)
    question(library.database(), "remove_curriculum").bind("curriculum_id", curriculum_id).run();
  else
    set_state(library.database(), curriculum_id, CurriculumState::retired, account->person_id);
  audit(library, draft ? Act::remove_curriculum : Act::retire_curriculum, {"curriculum", curriculum_id});
  transaction.commit();
  return {};
}

std::vector<FamilyVersion> versions_of(Library& library, const std::string& family_id) {
  std::vector<FamilyVersion> versions;
  Statement rows = question(library.database(), "versions_of_family");
  for (rows.bind("family_id", family_id); rows.step();)
    versions.push_back({rows.text("case_id"), rows.text("title"), *case_state_from(rows.view("state")),
                        rows.small_integer("version"), rows.view("audience") == "own_cohort"});
  return versions;
}

std::vector<Curriculum> list_curricula(Library& library) {
  std::vector<Curriculum> all;
  for (Statement rows = question(library.database(), "curricula"); rows.step();)
    all.push_back(read_curriculum(library.database(), rows));
  return all;
}

base::Result<Curriculum> find_curriculum(Library& library, const std::string& curriculum_id) {
  for (Curriculum& one : list_curricula(library))
    if (one.curriculum_id == curriculum_id) return std::move(one);
  return base::Error{"no_curriculum", "there is no such curriculum in the library"};
}

}  // namespace seldinger::casedb
