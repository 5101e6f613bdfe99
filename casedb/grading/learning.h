// Attempts as a course of learning: whose, at which case, in which order, and whether they passed. What charts,
// reliability and reports about learners and cases are made of.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "casedb/grading/grading.h"

namespace seldinger::casedb {

// Never in one answer: what people did, and what simulated people did (casedb/people/simulated_people.h).
enum class Learners { people, simulated };

struct LearningAttempt {
  std::string attempt_id, person_id;
  std::string case_id, family_id;  // all versions of a case are one family
  std::int64_t started_us = 0;
  assessment::Verdict verdict = assessment::Verdict::no_rule;
  std::vector<MetricValue> metrics;  // newest version of each
  Task task{};                       // what was done there

  // Whether it says anything: passed or failed.
  bool graded() const noexcept {
    return verdict == assessment::Verdict::passed || verdict == assessment::Verdict::failed;
  }
  bool passed() const noexcept { return verdict == assessment::Verdict::passed; }
};

// Oldest first.
std::vector<LearningAttempt> learning_attempts(Library& library, Learners learners);
// The same without metrics, for what asks who passed: of 20,000 attempts they take 200 MB.
std::vector<LearningAttempt> learning_verdicts(Library& library, Learners learners);

// Another one when learning_attempts, cohorts or what was done in them may have changed: by an act, or by attempts.
struct LearningMark {
  std::string act, attempts;
};
LearningMark learning_mark(Library& library);

// With metrics, of one: of a person what they did, of a simulated one what was simulated of them.
std::vector<LearningAttempt> learning_attempts_of(Library& library, const std::string& person_id);

}  // namespace seldinger::casedb
