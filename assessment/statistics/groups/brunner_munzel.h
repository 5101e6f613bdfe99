// Whether values of one group tend to be larger, with unequal shapes and ties: the test of Brunner and Munzel
// (Biom. J. 42, 2000), by studentised permutation where groups are small (Neubert, Brunner, Comput. Stat. Data
// Anal. 51, 2007).
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "assessment/statistics/answer.h"
#include "assessment/statistics/data_table.h"
#include "assessment/statistics/deals.h"
#include "assessment/statistics/procedure.h"

namespace seldinger::assessment::statistics {

// P(first > second) + ½ P(first = second), with its standard error; 0 where the groups do not overlap.
struct Superiority {
  double estimate = 0.5, error = 0.0, df = 0.0;

  double statistic() const { return (estimate - 0.5) / error; }
};
// Two values or more in each, not all the same.
Superiority superiority(std::span<const double> a, std::span<const double> b);

// By t on the logit scale; where the groups do not overlap Newcombe's (Stat. Med. 25, 2006, method 5).
Interval superiority_interval(const Superiority& superiority, double n1, double n2);

struct PermutationTest {
  double p_value = 1.0;
  bool all = false;       // all deals were gone through
  double smallest = 0.0;  // the least p that there can be
};
PermutationTest studentised_permutation(std::span<const double> a, std::span<const double> b, std::size_t draws,
                                        std::uint64_t seed);

Answer brunner_munzel(const DataTable& table, const ProcedureOptions& options);

}  // namespace seldinger::assessment::statistics
