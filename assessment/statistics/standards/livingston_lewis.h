// How far a cut's decisions can be relied on where scores have ends and are not normal: true scores by a beta
// distribution, observed ones binomial about them, on as many items as go with the reliability (Livingston, Lewis,
// J. Educ. Meas. 32:179, 1995; here with two parameters, between the ends of the scale).
#pragma once

#include <optional>

#include "assessment/statistics/standards/classification.h"

namespace seldinger::assessment::statistics {

struct BetaScores {
  double mean = 0.0, sd = 0.0;   // of the observed scores
  double low = 0.0, high = 1.0;  // ends of the scale
  double reliability = 0.0;
  double cut = 0.0;  // that score itself passes
};
// The number of items that would give this reliability.
double effective_length(const BetaScores& of);
// Nothing: the scores vary more than is possible between these ends, or as one item does.
std::optional<Classification> livingston_lewis_of(const BetaScores& of);

}  // namespace seldinger::assessment::statistics
