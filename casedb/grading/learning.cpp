#include "casedb/grading/learning.h"

#include <algorithm>
#include <map>
#include <set>

#include "casedb/people/simulated_people.h"

namespace seldinger::casedb {

std::vector<LearningAttempt> learning_attempts(Library& library, Learners learners) {
  std::set<std::string> simulated;
  for (const SimulatedTruth& one : list_simulated_truths(library)) simulated.insert(one.person_id);
  std::map<std::string, std::string> families;
  for (const CaseRow& row : list_case_heads(library)) families[row.case_id] = row.family_id;
  Grader grader(library);
  std::vector<LearningAttempt> all;
  for (AttemptRow& row : list_attempts(library)) {
    const bool wanted =
        learners == Learners::people ? by_a_person(row) : row.person_id && simulated.contains(*row.person_id);
    if (!wanted) continue;
    const assessment::Verdict verdict = grader.grade(row).verdict;
    all.push_back({row.attempt_id, *row.person_id, row.case_id, families[row.case_id], row.started_us, verdict,
                   std::move(row.metrics)});
  }
  std::reverse(all.begin(), all.end());
  return all;
}

}  // namespace seldinger::casedb
