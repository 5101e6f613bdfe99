// Ranks of two groups: the Mann–Whitney test, exact given the ties that there are, and the shift of Hodges and
// Lehmann with its exact interval.
#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include "assessment/statistics/answer.h"
#include "assessment/statistics/data_table.h"
#include "assessment/statistics/procedure.h"

namespace seldinger::assessment::statistics {

// Up to this many persons of both groups the test is exact.
inline constexpr std::size_t kMostExact = 100;

struct RankSumTest {
  double u = 0.0;  // pairs in which the first group's value is the larger; ties are halves
  double p_value = 1.0;
  double p_upper = 1.0;   // one-sided: that the first group's values are the larger
  double smallest = 0.0;  // the least p that these ranks can give; 0: not exact
};
// Of all ways to deal the values that there are to two groups of these sizes, those as far from the middle or
// further: P(|U − n₁n₂/2| ≥ observed).
RankSumTest exact_rank_sum(std::span<const double> a, std::span<const double> b);
// By the normal distribution, its variance corrected for ties. NaN where all values are the same.
RankSumTest normal_rank_sum(std::span<const double> a, std::span<const double> b, bool continuity_correction);

struct Shift {
  double estimate = 0.0;
  std::optional<Interval> ci95;  // nothing: with so few even the widest holds less than 95 %
};
// Median of all differences first − second. The interval inverts the test without ties, and is conservative with.
Shift hodges_lehmann(std::span<const double> a, std::span<const double> b);

Answer mann_whitney(const DataTable& table, const ProcedureOptions& options);

}  // namespace seldinger::assessment::statistics
