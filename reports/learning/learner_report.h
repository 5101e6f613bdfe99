// The report of one learner, a case a section: how values changed with practice, whether failures have become as
// rare as they should (LC-CUSUM), and how probable it is that the learner is proficient now.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "assessment/statistics/answer.h"
#include "casedb/grading/learning.h"
#include "casedb/people/simulated_people.h"
#include "reports/learning/learning_charts.h"

namespace seldinger::reports {

struct LearnerReport {
  std::string learner;  // as the reader may call them
  casedb::Learners whose = casedb::Learners::people;
  std::int64_t made_us = 0;
  std::string program_version;
  std::vector<LearnerItem> items;                // in the order in which the learner came to them
  assessment::statistics::Answer dependability;  // of passing, over everybody
  std::optional<casedb::SimulatedTruth> truth;
};

// Of somebody who made no attempt a report without items.
LearnerReport learner_report_of(casedb::Library& library, casedb::Learners whose, const std::string& person_id,
                                const std::string& learner, const std::string& program_version);

// Deterministic: the same report, the same bytes.
std::string learner_report_page(const LearnerReport& report);

}  // namespace seldinger::reports
