// Ranks of paired differences: Wilcoxon's signed-rank test, exact given ties and zeros, and the middle of the
// differences with its exact interval.
#pragma once

#include <span>
#include <vector>

#include "assessment/statistics/answer.h"
#include "assessment/statistics/data_table.h"
#include "assessment/statistics/groups/mann_whitney.h"
#include "assessment/statistics/procedure.h"

namespace seldinger::assessment::statistics {

struct SignedRankTest {
  double v = 0.0;  // sum of the ranks of positive differences
  double p_value = 1.0;
  double p_upper = 1.0;   // one-sided: that differences are positive
  double smallest = 0.0;  // 0: not exact
  std::size_t zeros = 0;
  const char* reason = nullptr;
};
// Zeros are dropped before ranks are given (Wilcoxon) or after (`pratt`: Pratt, JASA 54, 1959).
SignedRankTest exact_signed_rank(std::span<const double> differences, bool pratt);
SignedRankTest normal_signed_rank(std::span<const double> differences, bool pratt);

// Median of the means of all pairs of differences, zeros too.
Shift pseudo_median(std::span<const double> differences);

Answer wilcoxon(const DataTable& table, const ProcedureOptions& options);

}  // namespace seldinger::assessment::statistics
