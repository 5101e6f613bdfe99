// A stored attempt's grade, score and debrief: computed when looked at, from what is stored (docs/decisions/0022).
#pragma once

#include <map>
#include <string>
#include <tuple>
#include <vector>

#include "assessment/grading/debrief.h"
#include "casedb/attempts/attempts.h"
#include "casedb/cases/cases.h"

namespace seldinger::casedb {

// By the rule of the case that the attempt was made on.
assessment::Grade grade_of(const AttemptRow& attempt, const CaseSetting& setting);

// Whether consultants have set the standard for a case as it is set: at one of its targets, with its own guidance.
bool has_standard(Library& library, const CaseRow& row);

// Whether a person made it; what was simulated in a person's name is simulated.
bool by_a_person(const AttemptHead& attempt) noexcept;

struct AttemptGrade {
  assessment::Grade grade;
  // Of the same target, guidance, approach and kind of needle: the consultants', and where these have no band, the
  // simulated expert's, which is no standard.
  assessment::ExpertSet experts;
  bool provisional = true;  // too few consultants have set the standard
  assessment::Score score;  // against consultants only
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
  using Task = std::tuple<std::string, std::string, cases::Modality, cases::Approach, cases::InstrumentKind>;
  struct Experts {
    assessment::ExpertSet consultants, simulated;
  };
  const CaseSetting& setting_of(const std::string& case_id);
  const Experts& experts_of(const AttemptRow& attempt);

  Library* library_;
  std::map<std::string, CaseSetting> settings_;
  std::map<Task, Experts> experts_;
};

}  // namespace seldinger::casedb
