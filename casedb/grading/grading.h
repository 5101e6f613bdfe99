// A stored attempt's grade, score and debrief: computed when looked at, from what is stored (docs/decisions/0022).
#pragma once

#include <map>
#include <string>
#include <vector>

#include "assessment/grading/debrief.h"
#include "casedb/attempts/attempts.h"
#include "casedb/cases/cases.h"
#include "casedb/grading/standards.h"

namespace seldinger::casedb {

// By the rule of the case that the attempt was made on.
assessment::Grade grade_of(const AttemptRow& attempt, const CaseSetting& setting);

// Whether there is a standard for a case as it is set: at one of its targets, with its own guidance.
bool has_standard(Library& library, const CaseRow& row);

// Whether a person made it; what was simulated in a person's name is simulated.
bool by_a_person(const AttemptHead& attempt) noexcept;

struct AttemptGrade {
  assessment::Grade grade;
  // The standard of its task; where there is none, who has made how many attempts towards one, without a number.
  assessment::ExpertSet experts;
  bool provisional = true;  // nobody has set a standard
  assessment::Score score;
  std::vector<assessment::Sentence> debrief;
};

// Grades attempts of a library; what it has read of cases and experts it keeps, so it is made anew for each
// question.
class Grader {
 public:
  explicit Grader(Library& library) : library_(&library) {}
  assessment::Grade grade(const AttemptRow& attempt);
  AttemptGrade look_at(const AttemptRow& attempt);

 private:
  const CaseSetting& setting_of(const std::string& case_id);
  const assessment::ExpertSet& experts_of(const AttemptRow& attempt);

  Library* library_;
  std::map<std::string, CaseSetting> settings_;
  std::map<Task, assessment::ExpertSet> experts_;
};

}  // namespace seldinger::casedb
