// What a study's values say of agreement and of decisions: computed once, told by a panel and by the report's data.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "assessment/statistics/answer.h"
#include "reports/studies/validity_report.h"

namespace seldinger::reports {

// ICC(2,1) of the last two attempts of every person who has two with a value.
assessment::statistics::Answer agreement_of(const assessment::study::Compared& one);

// What an outcome is held against: the frozen cut of its case, else its case's rule.
struct PassMark {
  double cut = 0.0;
  bool higher_is_better = true;
  std::string words;
};
std::optional<PassMark> pass_mark_of(const ValidityReport& report, const assessment::study::Outcome& outcome);

// Of a group how many are at the mark; who failed is not.
struct AtMark {
  std::int64_t passed = 0, n = 0;
};
AtMark at_mark(const assessment::study::Compared& one, const std::string& group, const PassMark& mark);

// How often a second test would decide alike, by that agreement.
assessment::statistics::Answer decisions_of(const assessment::study::Compared& one, const PassMark& mark,
                                            const assessment::statistics::Answer& agreement);

}  // namespace seldinger::reports
