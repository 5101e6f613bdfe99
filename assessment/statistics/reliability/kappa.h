// Cohen's kappa: how far two raters' categories agree beyond what chance gives them, with weights for near misses.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "assessment/statistics/answer.h"
#include "assessment/statistics/complete_table.h"

namespace seldinger::assessment::statistics {

// What two ratings that differ are worth: nothing; 1 less their distance; 1 less its square (of the largest).
enum class KappaWeights { kNone, kLinear, kQuadratic };

struct Kappa {
  double value = 0.0;
  double observed = 0.0, expected = 0.0;  // agreement, weighted
  double se = 0.0;                        // about the estimate (Fleiss, Cohen, Everitt, Psychol. Bull. 72, 1969)
  double se_of_none = 0.0;                // if there were no agreement beyond chance
};
// Of pairs of ratings, each one of `categories` (in rising order).
Kappa kappa_of(std::span<const double> a, std::span<const double> b, std::span<const double> categories,
               KappaWeights weights);

// Of two raters; of more, Light's mean over pairs of raters, with an interval by the jackknife, and every pair as a
// row.
Answer kappa(const CompleteTable& table, KappaWeights weights);

}  // namespace seldinger::assessment::statistics
