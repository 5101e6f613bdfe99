// A standard that judges bound on both sides (Hofstee, in Anderson, Helmick, On Educational Testing, 1983): between
// the cuts and the shares of failing that they accept, where the line from (least cut, most failing) to (most cut,
// least failing) meets the share of persons that each cut fails.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "assessment/statistics/answer.h"

namespace seldinger::assessment::statistics {

// One number for each judge, or one that all agreed on. Shares are from 0 to 1.
struct HofsteeLimits {
  std::vector<double> cut_low, cut_high, fail_low, fail_high;
};

// The means over judges.
struct HofsteeCorners {
  double cut_low = 0.0, cut_high = 0.0, fail_low = 0.0, fail_high = 0.0;
};
// A score below the cut fails. Nothing: persons fail more, or less, often than what is accepted at any accepted
// cut. `scores` rise; the corners' lows are below their highs.
std::optional<double> hofstee_cut(const std::vector<double>& scores, const HofsteeCorners& corners);

// `higher_is_better`: else a score above the cut fails. The interval: persons, and judges where there are several,
// drawn again.
Answer hofstee(std::vector<double> scores, std::size_t missing, const HofsteeLimits& limits, bool higher_is_better,
               std::size_t draws, std::uint64_t seed);

}  // namespace seldinger::assessment::statistics
