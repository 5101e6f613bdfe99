// Shares of persons who passed: their intervals, and the difference of two.
#pragma once

#include <cstdint>

#include "assessment/statistics/answer.h"
#include "assessment/statistics/data_table.h"
#include "assessment/statistics/procedure.h"

namespace seldinger::assessment::statistics {

// 95 % intervals of a share, k of n; n from 1.
Interval wilson_interval(std::int64_t k, std::int64_t n);
Interval clopper_pearson_interval(std::int64_t k, std::int64_t n);
// How often Wilson's interval holds the true share p, by enumeration of all k.
double wilson_coverage(std::int64_t n, double p);

// Of the difference k1/n1 − k2/n2: Newcombe's hybrid of two Wilson intervals.
Interval newcombe_interval(std::int64_t k1, std::int64_t n1, std::int64_t k2, std::int64_t n2);

// Values 0 and 1; with groups, a row for each.
Answer one_proportion(const DataTable& table, const ProcedureOptions& options);

}  // namespace seldinger::assessment::statistics
