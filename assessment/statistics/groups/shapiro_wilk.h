// Whether a sample may come from a normal distribution: Shapiro and Wilk's W. It describes; no test is chosen by
// it.
#pragma once

#include <span>

#include "assessment/statistics/answer.h"
#include "assessment/statistics/data_table.h"
#include "assessment/statistics/procedure.h"

namespace seldinger::assessment::statistics {

struct ShapiroWilk {
  double w = 0.0, p_value = 1.0;
};
// By Royston's approximation (AS R94, Appl. Statist. 44, 1995); 3 to 5000 values that vary, in any order.
ShapiroWilk shapiro_wilk(std::span<const double> values);

// By group where groups are given.
Answer shapiro(const DataTable& table, const ProcedureOptions& options);

}  // namespace seldinger::assessment::statistics
