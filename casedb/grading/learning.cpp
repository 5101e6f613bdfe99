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

// Takes rows as the library lists them, newest first; answers oldest first.
class Courses {
 public:
  explicit Courses(Library& library) : grader_(library) {
    for (const CaseRow& row : list_case_heads(library)) families_[row.case_id] = row.family_id;
  }

  void add(AttemptRow& row, bool with_metrics) {
    all_.push_back({row.attempt_id,
                    *row.person_id,
                    row.case_id,
                    families_[row.case_id],
                    row.started_us,
                    grader_.grade(row).verdict,
                    {},
                    task_of(row)});
    if (with_metrics) all_.back().metrics = std::move(row.metrics);
  }

  std::vector<LearningAttempt> answer() {
    std::reverse(all_.begin(), all_.end());
    return std::move(all_);
  }

 private:
  std::map<std::string, std::string> families_;
  Grader grader_;
  std::vector<LearningAttempt> all_;
};

std::vector<LearningAttempt> read_learning(Library& library, Learners learners, bool with_metrics) {
  const Snapshot one_state(library.database());
  const std::set<std::string> simulated = simulated_people(library);
  Courses courses(library);
  for (std::size_t first = 0;; first += kAtATime) {
    std::vector<AttemptRow> rows = list_attempts(library, first, kAtATime);
    for (AttemptRow& row : rows)
      if (learners == Learners::people ? by_a_person(row) : row.person_id && simulated.contains(*row.person_id))
        courses.add(row, with_metrics);
    if (rows.size() < kAtATime) break;
  }
  return courses.answer();
}

}  // namespace

std::vector<LearningAttempt> learning_attempts(Library& library, Learners learners) {
  return read_learning(library, learners, true);
}

std::vector<LearningAttempt> learning_verdicts(Library& library, Learners learners) {
  return read_learning(library, learners, false);
}

std::vector<LearningAttempt> learning_attempts_of(Library& library, const std::string& person_id) {
  const bool is_one = is_simulated(library, person_id);
  Courses courses(library);
  for (AttemptRow& row : list_attempts_of(library, person_id))
    if (is_one || by_a_person(row)) courses.add(row, true);
  return courses.answer();
}

LearningMark learning_mark(Library& library) {
  Statement mark = question(library.database(), "learning_mark");
  CHECK(mark.step());
  return {std::to_string(mark.integer("act")), std::to_string(mark.integer("attempt"))};
}

}  // namespace seldinger::casedb
