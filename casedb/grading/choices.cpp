#include "casedb/grading/choices.h"

#include <algorithm>

#include "casedb/cases/changeable_case.h"
#include "casedb/cases/permissions.h"
#include "casedb/grading/curriculum.h"
#include "casedb/grading/grading.h"

namespace seldinger::casedb {
namespace {

Choice choice_of(const CaseRow& row) {
  Choice choice;
  choice.case_id = row.case_id;
  choice.title = row.title;
  choice.modality = row.modality;
  choice.difficulty = row.difficulty;
  return choice;
}

Choice choice_of(const CaseRow& row, const Curriculum& curriculum, const ItemState& item) {
  Choice choice = choice_of(row);
  choice.curriculum = curriculum.title;
  choice.attempts = item.attempts;
  choice.passes = item.passes;
  choice.attempts_left = item.progress.attempts_left;
  choice.open = item.progress.open && choice.attempts_left.value_or(1) > 0;
  choice.due = item.progress.due;
  choice.reached = item.progress.reached;
  return choice;
}

// Practice alone freezes a draft, whoever's it was.
bool is_frozen(Library& library, const CaseRow& row) {
  const auto changeable = changeable_case(library, row.case_id);
  return !changeable && changeable.error().code == "has_attempts";
}

Subject subject_of(Library& library, const CaseRow& row, const std::string& person_id) {
  Subject subject = row.state;
  subject.reached = !row.own_cohort_only || reaches_own_cohort(library, row.case_id, person_id);
  return subject;
}

// Whether it stands alone, to be practised out of any curriculum.
bool can_be_practised(Library& library, const CaseRow& row, const std::string& person_id, Role role) {
  if (!may(role, Action::practise_case, subject_of(library, row, person_id))) return false;
  if (row.state == CaseState::draft && !is_frozen(library, row)) return false;
  return !list_lesions(library, row.case_id).empty();
}

void count_attempts(const std::vector<AttemptRow>& attempts, Grader& grader, Choice& choice) {
  for (const AttemptRow& attempt : attempts) {
    if (attempt.case_id != choice.case_id || !by_a_person(attempt)) continue;
    ++choice.attempts;
    if (grader.grade(attempt).verdict == assessment::Verdict::passed) ++choice.passes;
  }
}

}  // namespace

Choices choices_of(Library& library, const std::string& person_id, Role role) {
  Choices choices;
  const std::vector<CaseRow> rows = list_case_heads(library);
  for (const Curriculum& curriculum : list_curricula(library)) {
    if (curriculum.state != CurriculumState::published) continue;
    for (const ItemState& item : states_of(library, curriculum, person_id)) {
      const auto row =
          std::find_if(rows.begin(), rows.end(), [&](const CaseRow& one) { return one.case_id == item.case_id; });
      if (row == rows.end() || !may(role, Action::practise_case, subject_of(library, *row, person_id))) continue;
      choices.cases.push_back(choice_of(*row, curriculum, item));
    }
  }
  Grader grader(library);
  const std::vector<AttemptRow> attempts = list_attempts_of(library, person_id);
  const auto is_listed = [&](const CaseRow& row) {
    return std::any_of(choices.cases.begin(), choices.cases.end(),
                       [&](const Choice& one) { return one.case_id == row.case_id; });
  };
  for (const CaseRow& row : rows) {
    if (may(role, Action::work_on_case, row.state))
      choices.drafts.push_back({row.case_id, row.title, row.state, row.modality, row.version});
    if (is_listed(row) || !can_be_practised(library, row, person_id, role)) continue;
    count_attempts(attempts, grader, choices.cases.emplace_back(choice_of(row)));
  }
  return choices;
}

const Choice* next_of(const Choices& choices) noexcept {
  const auto next = std::find_if(choices.cases.begin(), choices.cases.end(),
                                 [](const Choice& choice) { return choice.due && choice.open; });
  return next == choices.cases.end() ? nullptr : &*next;
}

}  // namespace seldinger::casedb
