// A standard from scores and an examiner's global rating of each person: the score that goes with the rating
// "borderline", by regression on all persons (Kramer et al., Med. Educ. 37, 2003) or as the mean of the borderline
// persons (Livingston, Zieky, Passing Scores, 1982).
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "assessment/statistics/answer.h"

namespace seldinger::assessment::statistics {

enum class BorderlineMethod { kRegression, kGroup };

struct RatedScores {
  std::vector<double> score, rating;  // of each person
  std::size_t missing = 0;
  double borderline = 0.0;  // the rating that is it
};
// Both methods stand in the rows, `method` is the answer. The interval: persons drawn again.
Answer borderline(const RatedScores& rated, BorderlineMethod method, std::size_t draws, std::uint64_t seed);

}  // namespace seldinger::assessment::statistics
