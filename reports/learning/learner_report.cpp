#include "reports/learning/learner_report.h"

#include "casedb/database/uuid.h"
#include "casedb/grading/dependability.h"

namespace seldinger::reports {

LearnerReport learner_report_of(casedb::Library& library, casedb::Learners whose, const std::string& person_id,
                                const std::string& learner, const std::string& program_version) {
  LearnerReport report{learner, whose, casedb::now_us(), program_version, {}, {}, {}};
  std::vector<casedb::LearningAttempt> attempts = casedb::learning_attempts(library, whose);
  report.dependability = casedb::dependability(attempts);
  std::erase_if(attempts, [&](const casedb::LearningAttempt& one) { return one.person_id != person_id; });
  report.items = learner_items(library, std::move(attempts));
  if (whose == casedb::Learners::simulated)
    for (const casedb::SimulatedTruth& one : casedb::list_simulated_truths(library))
      if (one.person_id == person_id) report.truth = one;
  return report;
}

}  // namespace seldinger::reports
