// The report of a case's cuts: what each method says, on one axis, with what it rests on, and which one holds.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "assessment/statistics/answer.h"
#include "casedb/cases/cases.h"
#include "casedb/grading/cuts.h"

namespace seldinger::reports {

struct StandardReport {
  std::string title;  // the case's
  int version = 1;
  std::int64_t made_us = 0;
  std::string program_version;
  assessment::PassRule rule;
  std::vector<casedb::Cut> cuts;                 // oldest first
  assessment::statistics::Answer dependability;  // of passing, by what people did
};
StandardReport standard_report_of(casedb::Library& library, const casedb::CaseRow& row,
                                  const std::string& program_version);

// Deterministic: the same report, the same bytes.
std::string standard_report_page(const StandardReport& report);

}  // namespace seldinger::reports
