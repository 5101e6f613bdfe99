#include "casedb/grading/learning.h"

#include <algorithm>
#include <map>
#include <set>

#include "casedb/people/simulated_people.h"

namespace seldinger::casedb {
namespace {

// Newest first, as the library lists them; answered oldest first.
std::vector<LearningAttempt> learned_from(Library& library, std::vector<AttemptRow> rows) {
  std::map<std::string, std::string> families;
  for (const CaseRow& row : list_case_heads(library)) families[row.case_id] = row.family_id;
  Grader grader(library);
  std::vector<LearningAttempt> all;
  for (AttemptRow& row : rows) {
    const assessment::Verdict verdict = grader.grade(row).verdict;
    all.push_back({row.attempt_id, *row.person_id, row.case_id, families[row.case_id], row.started_us, verdict,
                   std::move(row.metrics), task_of(row)});
  }
  std::reverse(all.begin(), all.end());
  return all;
}

}  // namespace

std::vector<LearningAttempt> learning_attempts(Library& library, Learners learners) {
  std::set<std::string> simulated;
  for (const SimulatedTruth& one : list_simulated_truths(library)) simulated.insert(one.person_id);
  std::vector<AttemptRow> rows = list_attempts(library);
  std::erase_if(rows, [&](const AttemptRow& row) {
    return learners == Learners::people ? !by_a_person(row) : !row.person_id || !simulated.contains(*row.person_id);
  });
  return learned_from(library, std::move(rows));
}

std::vector<LearningAttempt> learning_attempts_of(Library& library, const std::string& person_id) {
  std::vector<AttemptRow> rows = list_attempts_of(library, person_id);
  if (!is_simulated(library, person_id))
    std::erase_if(rows, [](const AttemptRow& row) { return !by_a_person(row); });
  return learned_from(library, std::move(rows));
}

}  // namespace seldinger::casedb
