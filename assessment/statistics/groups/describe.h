// What a sample looks like: middle, spread, ends, and the interval of its mean.
#pragma once

#include <span>

#include "assessment/statistics/answer.h"
#include "assessment/statistics/data_table.h"
#include "assessment/statistics/procedure.h"

namespace seldinger::assessment::statistics {

// Type 7 of Hyndman and Fan (Am. Stat. 50, 1996), R's default: linear between the values at (n − 1)p. Values
// ascend, one or more.
double quantile_of(std::span<const double> sorted, double p);
// Scaled by 1.4826, as a normal's SD.
double median_absolute_deviation(std::span<const double> values);

Answer describe(const DataTable& table, const ProcedureOptions& options);

}  // namespace seldinger::assessment::statistics
