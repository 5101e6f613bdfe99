// One learner at one case, drawn: how probable it is that they are proficient, whether failures have become rare,
// and how the value of each criterion changed with practice. The same in reports and on pages.
#pragma once

#include <string>
#include <vector>

#include "assessment/grading/standard.h"
#include "casedb/grading/learning.h"
#include "reports/markup/html.h"

namespace seldinger::reports {

// A case in all its versions, and what the learner did there.
struct LearnerItem {
  std::string title;
  assessment::PassRule rule;                      // of the version that they attempted last
  assessment::ExpertSet experts;                  // the standard of what they did there last; may be none
  std::vector<casedb::LearningAttempt> attempts;  // oldest first, graded or not
};

// In the order in which the learner came to them. `attempts` are theirs alone, oldest first.
std::vector<LearnerItem> learner_items(casedb::Library& library, std::vector<casedb::LearningAttempt> attempts);

// "12 of 17 graded attempts passed; 1 more are not graded"
std::string passed_text(const LearnerItem& item);
// Charts with what they say, and all their numbers as a table; headings are h3.
Html learning_charts(const LearnerItem& item);

}  // namespace seldinger::reports
