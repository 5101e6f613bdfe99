// The validity report of a study: one file that opens offline and prints. The argument comes first, then what was
// found, by Messick's sources of validity, then what the numbers cannot say and how they came about.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "assessment/study/analysis.h"
#include "casedb/people/consent.h"
#include "casedb/ratings/rated_people.h"
#include "casedb/studies/lock.h"
#include "casedb/studies/looks.h"
#include "casedb/studies/study_data.h"
#include "reports/studies/numbers/decision_numbers.h"
#include "reports/studies/numbers/form_reliability.h"

namespace seldinger::reports {

struct ValidityReport {
  casedb::Study study;
  casedb::StoredPlan plan;
  std::int64_t made_us = 0;
  std::string program_version;
  std::map<std::string, std::string> case_titles;  // by id
  casedb::BlindedCounts blinded;                   // of a draft: all that is told
  // Of a frozen plan.
  casedb::ParticipantFlow flow;
  assessment::study::StudyResult result;
  std::string data_hash;
  std::optional<casedb::StudyLock> lock;
  std::vector<casedb::RatedPeople> ratings;
  std::vector<casedb::RatedRound> rated_rounds;
  std::vector<FormReliability> forms;
  CaseMarks marks;                                        // of the plan's cases
  std::map<std::string, casedb::Background> backgrounds;  // by pseudonym
  std::vector<casedb::StudyNote> looks, deviations;
};

// Of a frozen plan it is itself a look: whoever makes it notes that first, so that it is among those it tells.
ValidityReport validity_report_of(casedb::Library& library, const casedb::Study& study,
                                  const casedb::StoredPlan& plan, const std::string& query,
                                  const std::string& program_version);

// Deterministic: the same report, the same bytes.
std::string validity_page(const ValidityReport& report);

}  // namespace seldinger::reports
