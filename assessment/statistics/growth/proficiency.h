// Whether a learner now passes as often as is asked, as a probability: Bayes' rule for a share with Jeffreys' prior
// (Brown, Cai, DasGupta, Stat. Sci. 16:101, 2001), over the last attempts, as earlier ones tell of an earlier
// skill.
#pragma once

#include <cstddef>

#include "assessment/statistics/answer.h"
#include "assessment/statistics/data_table.h"

namespace seldinger::assessment::statistics {

// Proficient: with a probability of `sure` or more the share of attempts passed is `share` or more.
struct ProficiencyRule {
  double share = 0.8, sure = 0.9;
  std::size_t last = 10;  // attempts that count
};
// What is asked of a rule: 0 < share < 1, 0 < sure < 1, 1 to 1000 attempts.
bool sound(const ProficiencyRule& rule);

// That the share is at least `share` after so many passes of so many attempts; passes ≤ attempts.
double probability_of_share(std::size_t passes, std::size_t attempts, double share);
// How probable two passes in a row are within so many attempts for who passes with probability p.
double two_running(double p, std::size_t attempts);

// Values are 1 (passed) and 0, in the order of x or of the rows. One person: the probability after each attempt.
// Several: a row each.
Answer proficiency(const DataTable& table, const ProficiencyRule& rule);

}  // namespace seldinger::assessment::statistics
