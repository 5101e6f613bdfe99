// What somebody can practise: which cases, from curricula and beside them, which of them are open, and which is
// due; and for who makes cases, those in the making. What a workstation lists after the log-in.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "assessment/grading/progress.h"
#include "casedb/cases/cases.h"
#include "casedb/people/people.h"

namespace seldinger::casedb {

// A case that somebody can practise, or could once it is open.
struct Choice {
  std::string case_id, title, curriculum;  // no curriculum: it stands alone
  cases::Modality modality = cases::Modality::mpr;
  Difficulty difficulty = Difficulty::moderate;
  int attempts = 0, passes = 0;                    // of the person; in a curriculum over all versions of the case
  bool open = true;                                // else a gate of the curriculum is shut, or no attempt is left
  bool due = false;                                // what comes next in its curriculum
  std::optional<assessment::Proficiency> reached;  // none out of a curriculum
  std::optional<int> attempts_left;                // none: no end, or out of a curriculum
  int passes_missing = 0;                          // running, to be proficient; 0 of who is
};

// A case in the making: a draft, or one in review.
struct CaseDraft {
  std::string case_id, title;
  CaseState state = CaseState::draft;
  cases::Modality modality = cases::Modality::mpr;
  int version = 1;
};

struct Choices {
  std::vector<Choice> cases;
  std::vector<CaseDraft> drafts;  // empty for whoever may not work on them
};

// First the items of each published curriculum, in their order, then what is not in one: published cases with a
// lesion, and for who may practise drafts too those that attempts have frozen (they are no longer changed, so
// practice does no harm; any other is tried in the case editor, which freezes nothing). A case may be in several
// curricula. Of each case the newest version that is published for the person: it takes its forerunner's place.
Choices choices_of(Library& library, const std::string& person_id, Role role);

// What comes next: the first that is due and open. Null: nothing is.
const Choice* next_of(const Choices& choices) noexcept;

// What follows once this case is passed: what is due; where nothing is, the next open case down the list and round
// again that is not proficient yet, before any other. The case itself where no other is open. Null: it is not
// among them.
const Choice* after_pass(const Choices& choices, const std::string& case_id) noexcept;

}  // namespace seldinger::casedb
