// Cumulative sums of successes and failures, and how probable it is that one reaches a limit: exactly, over the
// sums that can occur, not by simulation and not by a limit from the literature.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

namespace seldinger::assessment::statistics {

// S ← max(0, S + up) or max(0, S − down), both above 0; what is waited for is S ≥ limit.
struct CusumSteps {
  double up = 0.0, down = 0.0;
};

// Sums are compared with a limit to this much: as they are added up they differ in the last digits.
inline constexpr double kSumSlack = 1e-9;

// How probable it is that S reaches `limit` for the first time at attempt 1, 2, … `attempts`, each going up with
// probability `p_up`.
std::vector<double> reaching(const CusumSteps& steps, double p_up, double limit, std::size_t attempts);
// … within all of them.
double reached_within(const CusumSteps& steps, double p_up, double limit, std::size_t attempts);

// The least limit that is reached within `attempts` with a probability of at most `permitted`; it lies just above a
// sum that can occur. Nothing: even going up throughout is more probable than that.
std::optional<double> limit_for(const CusumSteps& steps, double p_up, double permitted, std::size_t attempts);

// How many attempts until S reaches `limit`, on average; NaN where that is longer than can be computed.
double run_length(const CusumSteps& steps, double p_up, double limit);

// S after each; true goes up.
std::vector<double> cusum_path(const CusumSteps& steps, const std::vector<bool>& ups);

}  // namespace seldinger::assessment::statistics
