#include "casedb/grading/learning.h"

#include <algorithm>
#include <map>
#include <set>

#include "casedb/database/question.h"
#include "casedb/database/sqlite.h"
#include "casedb/people/simulated_people.h"
#include "sim/base/check.h"

namespace seldinger::casedb {

namespace {

// So many at a time: an attempt with its metrics takes ten kilobytes.
constexpr std::size_t kAtATime = 1000;

std::vector<LearningAttempt> read_learning(Library& library, Learners learners, bool with_metrics) {
  const Snapshot one_state(library.database());
  std::set<std::string> simulated;
  for (const SimulatedTruth& one : list_simulated_truths(library)) simulated.insert(one.person_id);
  std::map<std::string, std::string> families;
  for (const CaseRow& row : list_case_heads(library)) families[row.case_id] = row.family_id;
  Grader grader(library);
  std::vector<LearningAttempt> all;
  for (std::size_t first = 0;; first += kAtATime) {
    std::vector<AttemptRow> rows = list_attempts(library, first, kAtATime);
    for (AttemptRow& row : rows) {
      const bool wanted =
          learners == Learners::people ? by_a_person(row) : row.person_id && simulated.contains(*row.person_id);
      if (!wanted) continue;
      all.push_back({row.attempt_id,
                     *row.person_id,
                     row.case_id,
                     families[row.case_id],
                     row.started_us,
                     grader.grade(row).verdict,
                     {}});
      if (with_metrics) all.back().metrics = std::move(row.metrics);
    }
    if (rows.size() < kAtATime) break;
  }
  std::reverse(all.begin(), all.end());
  return all;
}

}  // namespace

std::vector<LearningAttempt> learning_attempts(Library& library, Learners learners) {
  return read_learning(library, learners, true);
}

std::vector<LearningAttempt> learning_verdicts(Library& library, Learners learners) {
  return read_learning(library, learners, false);
}

LearningMark learning_mark(Library& library) {
  Statement mark = question(library.database(), "learning_mark");
  CHECK(mark.step());
  return {std::to_string(mark.integer("act")), std::to_string(mark.integer("attempt"))};
}

}  // namespace seldinger::casedb
