// A case rehearsed by a small population of the shipped operators before anybody practises it: their attempts are
// graded and forgotten. It tells whether the rule can be met at all, and proves nothing about trainees
// (docs/operators.md).
#pragma once

#include <array>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "assessment/grading/grade.h"
#include "casedb/cases/cases.h"

namespace seldinger::session {

inline constexpr std::array<std::string_view, 3> kRehearsedLevels = {"novice", "intermediate", "expert"};
inline constexpr const char* kRehearsalProves =
    "Simulated operators test the rule; they prove nothing about trainees.";

struct RehearsedLevel {
  std::string operator_name;  // of kRehearsedLevels, in their order
  std::size_t attempts = 0, passed = 0;
};

// A criterion of the rule, or the case's time limit, that attempts did not meet.
struct MissedCriterion {
  assessment::CriterionResult of;  // as the first of them had it
  std::size_t missed = 0;          // or without a value
};

struct Rehearsal {
  std::string content_mark;  // of the case as it was then (casedb::content_mark)
  std::size_t people = 0;    // of each level, one attempt each
  std::uint64_t seed = 0;
  std::vector<RehearsedLevel> levels;
  std::vector<MissedCriterion> missed;  // the most often missed first

  std::size_t attempts() const noexcept;  // fewer than planned where it was stopped
  std::size_t passed() const noexcept;
  bool stopped() const noexcept { return attempts() < people * levels.size(); }
};

struct RehearsalWish {
  std::size_t people = 8;
  std::uint64_t seed = 1;
  std::size_t jobs = 1;  // threads; the result is the same
  // Before the first attempt and after each, in turn a person of every level; false: no more of them.
  std::function<bool(std::size_t made, std::size_t of)> told{};
};

// Of the case as it is stored, at its first lesion; nothing is. Refused: `no_rule`, as prepare_task.
base::Result<Rehearsal> rehearse(casedb::Library& library, const std::string& case_id, const RehearsalWish& wish);

}  // namespace seldinger::session
