#include "reports/learning/learner_report.h"

#include <algorithm>

#include "casedb/database/uuid.h"
#include "casedb/grading/dependability.h"

namespace seldinger::reports {

LearnerReport learner_report_of(casedb::Library& library, casedb::Learners whose, const std::string& person_id,
                                const std::string& learner, const std::string& program_version) {
  LearnerReport report{learner, whose, casedb::now_us(), program_version, {}, {}, {}};
  std::vector<std::string> families;
  std::vector<casedb::LearningAttempt> attempts = casedb::learning_attempts(library, whose);
  report.dependability = casedb::dependability(attempts);
  for (casedb::LearningAttempt& one : attempts) {
    if (one.person_id != person_id) continue;
    const auto found = std::find(families.begin(), families.end(), one.family_id);
    const auto index = static_cast<std::size_t>(found - families.begin());
    if (found == families.end()) {
      families.push_back(one.family_id);
      report.items.emplace_back();
    }
    report.items[index].attempts.push_back(std::move(one));
  }
  for (const casedb::CaseRow& row : casedb::list_case_heads(library)) {  // oldest first: the newest version stays
    const auto found = std::find(families.begin(), families.end(), row.family_id);
    if (found == families.end()) continue;
    LearnerItem& item = report.items[static_cast<std::size_t>(found - families.begin())];
    item.title = row.title;
    item.rule = row.rule;
  }
  if (whose == casedb::Learners::simulated)
    for (const casedb::SimulatedTruth& one : casedb::list_simulated_truths(library))
      if (one.person_id == person_id) report.truth = one;
  return report;
}

}  // namespace seldinger::reports
