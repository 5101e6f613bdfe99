// Exact chances of rank sums under the null, given the ranks that there are, ties and all: the shift algorithm of
// Streitberg and Röhmel (EDV in Medizin und Biologie 18, 1987).
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace seldinger::assessment::statistics {

// Mid-ranks as whole numbers: doubled where one of them is a half.
struct WholeRanks {
  std::vector<int> scores;
  int unit = 1;  // what a rank of 1 is
};
WholeRanks whole_ranks(std::span<const double> midranks);

// chances[s]: that m of the scores, drawn without putting back, add up to s.
std::vector<double> chances_of_draws(std::span<const int> scores, std::size_t m);
// chances[s]: that the scores whose coin shows heads add up to s.
std::vector<double> chances_of_signs(std::span<const int> scores);

struct ExactTest {
  double two_sided = 1.0;  // of sums as far from the middle as `observed`, on both sides
  double upper = 1.0;      // of sums of `observed` or more
  double smallest = 1.0;   // the least two-sided p that these ranks can give
};
// `twice_middle`: double of the sum expected.
ExactTest exact_test(std::span<const double> chances, int observed, int twice_middle);
// The largest s with a chance below `tail` of sums of less than s; the s-th value from either end of ordered pairs
// bounds an interval. 0: not even the least sum is that rare.
std::size_t critical_sum(std::span<const double> chances, double tail);

}  // namespace seldinger::assessment::statistics
