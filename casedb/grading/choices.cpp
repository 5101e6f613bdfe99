#include "casedb/grading/choices.h"

#include <algorithm>
#include <map>

#include "casedb/cases/changeable_case.h"
#include "casedb/cases/permissions.h"
#include "casedb/grading/grading.h"
#include "casedb/grading/learner_records.h"

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
  choice.passes_missing = item.progress.passes_missing;
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

// Versions of a case beside each other, where the first of them stood.
std::vector<CaseRow> by_family(std::vector<CaseRow> rows) {
  std::map<std::string, std::size_t> place;
  for (const CaseRow& row : rows) place.emplace(row.family_id, place.size());
  std::stable_sort(rows.begin(), rows.end(), [&](const CaseRow& a, const CaseRow& b) {
    return place.at(a.family_id) < place.at(b.family_id);
  });
  return rows;
}

// `attempts`: newest first.
void count_attempts(const std::vector<AttemptRow>& attempts, Grader& grader, Choice& choice) {
  std::vector<assessment::Verdict> verdicts;
  for (auto attempt = attempts.rbegin(); attempt != attempts.rend(); ++attempt) {
    if (attempt->case_id != choice.case_id || !by_a_person(*attempt)) continue;
    verdicts.push_back(grader.grade(*attempt).verdict);
    ++choice.attempts;
    choice.passes += verdicts.back() == assessment::Verdict::passed ? 1 : 0;
  }
  choice.passes_missing = assessment::passes_missing(verdicts);
}

}  // namespace

Choices choices_of(Library& library, const std::string& person_id, Role role) {
  Choices choices;
  const std::vector<CaseRow> rows = by_family(list_case_heads(library));
  for (const Curriculum& curriculum : list_curricula(library)) {
    if (curriculum.state != CurriculumState::published) continue;
    for (const ItemState& item : states_of(library, curriculum, person_id)) {
      const auto row =
          std::find_if(rows.begin(), rows.end(), [&](const CaseRow& one) { return one.case_id == item.case_id; });
      if (row == rows.end() || !may(role, Action::practise_case, subject_of(library, *row, person_id))) continue;
      Choice& choice = choices.cases.emplace_back(choice_of(*row, curriculum, item));
      if (may(role, Action::skip_gates)) choice.open = choice.attempts_left.value_or(1) > 0;
    }
  }
  Grader grader(library);
  const std::vector<AttemptRow> attempts = list_attempts_of(library, person_id);
  const auto is_listed = [&](const CaseRow& row) {
    return std::any_of(choices.cases.begin(), choices.cases.end(),
                       [&](const Choice& one) { return one.case_id == row.case_id; });
  };
  // Whether a later version is published for them; of one for another cohort they know nothing.
  const auto is_replaced = [&](const CaseRow& row) {
    return row.state == CaseState::published && std::any_of(rows.begin(), rows.end(), [&](const CaseRow& later) {
             return later.family_id == row.family_id && later.version > row.version &&
                    later.state == CaseState::published && can_be_practised(library, later, person_id, role);
           });
  };
  for (const CaseRow& row : rows) {
    if (may(role, Action::work_on_case, row.state))
      choices.drafts.push_back({row.case_id, row.title, row.state, row.modality, row.version});
    if (is_listed(row) || is_replaced(row) || !can_be_practised(library, row, person_id, role)) continue;
    count_attempts(attempts, grader, choices.cases.emplace_back(choice_of(row)));
  }
  return choices;
}

const Choice* next_of(const Choices& choices) noexcept {
  const auto next = std::find_if(choices.cases.begin(), choices.cases.end(),
                                 [](const Choice& choice) { return choice.due && choice.open; });
  return next == choices.cases.end() ? nullptr : &*next;
}

const Choice* after_pass(const Choices& choices, const std::string& case_id) noexcept {
  const std::vector<Choice>& all = choices.cases;
  const auto own = std::find_if(all.begin(), all.end(), [&](const Choice& one) { return one.case_id == case_id; });
  if (own == all.end()) return nullptr;
  if (const Choice* due = next_of(choices)) return due;
  const Choice* other = nullptr;
  const auto at = static_cast<std::size_t>(own - all.begin());
  for (std::size_t i = 1; i < all.size(); ++i) {
    const Choice& one = all[(at + i) % all.size()];
    if (!one.open) continue;
    if (one.passes_missing > 0) return &one;
    if (other == nullptr) other = &one;
  }
  return other != nullptr ? other : &*own;
}

}  // namespace seldinger::casedb
