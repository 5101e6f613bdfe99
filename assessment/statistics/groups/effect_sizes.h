// How large the difference of two groups is, in standard deviations and in pairs, each with its interval.
#pragma once

#include <optional>
#include <span>

#include "assessment/statistics/answer.h"
#include "assessment/statistics/data_table.h"
#include "assessment/statistics/procedure.h"

namespace seldinger::assessment::statistics {

struct Effect {
  double value = 0.0;
  std::optional<Interval> ci95;
};
// Non-centralities under which `t` is as far out as 2.5 %, below and above; nothing where they cannot be computed.
std::optional<Interval> noncentrality_interval(double t, double df);

// First − second in standard deviations: pooled (Cohen), with Hedges' factor, of the second group (Glass), and of
// the mean variance; two values or more in each, which vary. Intervals are non-central t.
Effect cohen_d(std::span<const double> a, std::span<const double> b);
Effect hedges_g(std::span<const double> a, std::span<const double> b);
Effect glass_delta(std::span<const double> a, std::span<const double> b);
Effect unpooled_d(std::span<const double> a, std::span<const double> b);
// P(first > second) − P(first < second): the rank-biserial correlation. The interval is Fisher's z, which is too
// narrow where δ is large; where no pair is out of order Newcombe's, as superiority_interval() has it.
Effect cliff_delta(std::span<const double> a, std::span<const double> b);
// The same with the interval of Brunner and Munzel's probability.
Effect cliff_delta_by_superiority(std::span<const double> a, std::span<const double> b);

Answer effect_size(const DataTable& table, const ProcedureOptions& options);

}  // namespace seldinger::assessment::statistics
