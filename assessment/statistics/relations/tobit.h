// Two groups compared where values end at a limit (a time-out, a ceiling): normal values, of which those at the
// limit are only known to be beyond it.
#pragma once

#include <optional>
#include <vector>

#include "assessment/statistics/answer.h"
#include "assessment/statistics/data_table.h"
#include "assessment/statistics/procedure.h"

namespace seldinger::assessment::statistics {

struct Tobit {
  double mean_first = 0.0, mean_second = 0.0, sigma = 0.0;
  double standard_error = 0.0;  // of the difference of means
};
// By maximum likelihood, one σ; values at or above `limit` are censored. Each group has a value below it. Nothing
// where it does not converge.
std::optional<Tobit> tobit_of(const std::vector<double>& first, const std::vector<double>& second, double limit);

// Value by two groups; option `limit`.
Answer tobit(const DataTable& table, const ProcedureOptions& options);

}  // namespace seldinger::assessment::statistics
