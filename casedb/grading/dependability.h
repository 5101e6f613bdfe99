// How far passing tells persons apart: the library's own attempts as persons by cases by occasions, and Φ, the
// dependability of a decision that rests on so many cases (assessment/statistics/reliability/g_theory.h).
#pragma once

#include <chrono>
#include <optional>
#include <span>
#include <string>

#include "assessment/statistics/answer.h"
#include "assessment/statistics/data_table.h"
#include "casedb/grading/learning.h"

namespace seldinger::casedb {

// What a decision about a person is to reach, and what `cases_for_phi` of an answer counts up to.
constexpr double kDependable = 0.8;

// The largest full table that the attempts hold: of each person the last two graded attempts at each case, or the
// last one. Values are 1 (passed) and 0, `subject` is the person, `rater` the case's family, x the occasion. Of
// attempts that hold no two persons with two cases in common, all there is.
assessment::statistics::DataTable dependability_table(std::span<const LearningAttempt> attempts);

// Estimate and interval are of Φ of the mean over the table's cases; "phi_one_case" and "cases_for_phi" stand
// beside it. Under two cases or persons `too_few`.
assessment::statistics::Answer dependability(std::span<const LearningAttempt> attempts);

// Of all that people did in a library: what a page or a window tells beside a pass rule. Kept until somebody stores
// something, and in a large library a hundred times as long as it took to make: one more attempt changes it by next
// to nothing there.
class KeptDependability {
 public:
  const assessment::statistics::Answer& of(Library& library);

 private:
  using Clock = std::chrono::steady_clock;
  std::optional<assessment::statistics::Answer> answer_;
  std::string of_what_;
  Clock::time_point until_;
};

}  // namespace seldinger::casedb
