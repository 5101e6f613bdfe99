// How a surrogate held against attempts that it does not know did, in words.
#pragma once

#include <string>
#include <vector>

#include "assessment/population/agreement.h"

namespace seldinger::app {

struct LevelAgreement {
  std::string group;
  assessment::population::Agreement agreement;
};
struct GroupsAgreement {
  std::string less, more;
  std::vector<assessment::population::EffectAgreement> effects;
};
struct SurrogateAgreement {
  std::vector<LevelAgreement> levels;
  std::vector<GroupsAgreement> effects;  // of every other level against the first
};

// Effects that are further apart than 3 standard errors.
std::size_t effects_off(const GroupsAgreement& groups);
// The metric whose people of the same number in the two groups are most alike or most unlike.
const assessment::population::EffectAgreement& most_paired(const GroupsAgreement& groups);
// Whether chance makes the furthest of so many comparisons. With m of them, in one check of twenty or fewer one is
// off by more than `allowed_errors`, the normal distribution's quantile of 1 − .05 / 2m (Bonferroni).
struct Verdict {
  std::size_t comparisons = 0;
  double furthest_errors = 0.0, allowed_errors = 0.0;  // standard errors beyond what a comparison may be off by
  bool within_chance() const noexcept { return furthest_errors <= allowed_errors; }
};
Verdict verdict_of(const SurrogateAgreement& agreement);
std::string text_of_agreement(const SurrogateAgreement& agreement);  // Markdown

}  // namespace seldinger::app
