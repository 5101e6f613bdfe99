// Means and spreads of several groups: Welch's analysis of variance, and Brown and Forsythe's test of spreads.
#pragma once

#include <span>

#include "assessment/statistics/answer.h"
#include "assessment/statistics/data_table.h"
#include "assessment/statistics/procedure.h"

namespace seldinger::assessment::statistics {

struct FTest {
  double f = 0.0, df1 = 0.0, df2 = 0.0;
  const char* reason = nullptr;  // of reasons.h

  double p_value() const;
};
// With equal variances; two groups or more, together more persons than groups.
FTest one_way(std::span<const Group> groups);
// Without (Welch, Biometrika 38, 1951); two values or more in each.
FTest welch_one_way(std::span<const Group> groups);

Answer welch_anova(const DataTable& table, const ProcedureOptions& options);
// One-way on distances from the group's median (Brown, Forsythe, JASA 69, 1974).
Answer brown_forsythe(const DataTable& table, const ProcedureOptions& options);

}  // namespace seldinger::assessment::statistics
