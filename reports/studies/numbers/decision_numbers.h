// What a study's values say of agreement and of decisions: computed once, told by a panel and by the report's data.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "assessment/grading/rule.h"
#include "assessment/statistics/answer.h"
#include "assessment/study/analysis.h"
#include "casedb/grading/cuts.h"

namespace seldinger::reports {

// ICC(2,1) of the last two attempts of every person who has two with a value.
assessment::statistics::Answer agreement_of(const assessment::study::Compared& one);

// What an outcome is held against: the frozen cut of its case, else its case's rule.
struct PassMark {
  double cut = 0.0;
  bool higher_is_better = true;
  std::string words;
};
// By case id.
struct CaseMarks {
  std::map<std::string, assessment::PassRule> rules;
  std::map<std::string, std::vector<casedb::Cut>> cuts;
};
std::optional<PassMark> pass_mark_of(const CaseMarks& marks, const assessment::study::Outcome& outcome);

bool is_at_mark(const assessment::study::PersonValue& person, const PassMark& mark);  // who failed is not
// Of a group how many are.
struct AtMark {
  std::int64_t passed = 0, n = 0;
};
AtMark at_mark(const assessment::study::Compared& one, const std::string& group, const PassMark& mark);

// How often a second test would decide alike, by that agreement.
assessment::statistics::Answer decisions_of(const assessment::study::Compared& one, const PassMark& mark,
                                            const assessment::statistics::Answer& agreement);

}  // namespace seldinger::reports
