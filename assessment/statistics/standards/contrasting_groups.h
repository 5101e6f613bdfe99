// A standard from two groups of persons, one that has the competence and one that does not: the score at which the
// two groups' normal distributions cross (Livingston, Zieky, Passing Scores, 1982), and whom it passes and fails
// wrongly (Jørgensen, Konge, Subhi, Adv. Simul. 3:5, 2018).
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "assessment/statistics/answer.h"

namespace seldinger::assessment::statistics {

struct NormalScores {
  double mean = 0.0, sd = 0.0;
};
// Where the densities are the same between the two means: there is one such score or none. Of equal standard
// deviations it is the midpoint. Both standard deviations are above 0.
std::optional<double> normal_crossing(const NormalScores& a, const NormalScores& b);

// Shares, by the normal distributions.
struct WrongDecisions {
  double false_pass = 0.0, false_fail = 0.0;
};
// `higher_is_better`: a score at the cut or above passes; else at the cut or below.
WrongDecisions wrong_decisions(const NormalScores& without, const NormalScores& competent, double cut,
                               bool higher_is_better);

struct ContrastingGroups {
  GroupCount without_name, competent_name;
  std::vector<double> without, competent;  // scores of those without and with the competence
  bool higher_is_better = true;
  std::size_t missing = 0;
};
// The interval: persons drawn again within their groups, `draws` times, from `seed`; none for 0. Under five in a
// group there is no cut.
Answer contrasting_groups(const ContrastingGroups& groups, std::size_t draws, std::uint64_t seed);

}  // namespace seldinger::assessment::statistics
