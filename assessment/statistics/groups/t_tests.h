// Means of two groups or of pairs: Welch's and Student's t-test, the paired one, and equivalence.
#pragma once

#include <span>

#include "assessment/statistics/answer.h"
#include "assessment/statistics/data_table.h"
#include "assessment/statistics/procedure.h"

namespace seldinger::assessment::statistics {

struct MeanDifference {
  double estimate = 0.0, error = 0.0, df = 0.0;
  const char* reason = nullptr;  // of reasons.h: why there is none

  double t(double against = 0.0) const { return (estimate - against) / error; }
  double p_value() const;
  Interval interval(double confidence) const;
};
// First − second; two values each.
MeanDifference welch_difference(std::span<const double> a, std::span<const double> b);
MeanDifference pooled_difference(std::span<const double> a, std::span<const double> b);
// Mean of differences against 0.
MeanDifference mean_of(std::span<const double> differences);

Answer welch(const DataTable& table, const ProcedureOptions& options);
Answer student(const DataTable& table, const ProcedureOptions& options);
Answer paired(const DataTable& table, const ProcedureOptions& options);
// Two one-sided tests (Schuirmann, J. Pharmacokinet. Biopharm. 15, 1987), by Welch.
Answer tost(const DataTable& table, const ProcedureOptions& options);

}  // namespace seldinger::assessment::statistics
