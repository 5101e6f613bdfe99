// Many tests at once: Holm's and Benjamini and Hochberg's adjustments, and the permutation of Westfall and Young,
// which knows how outcomes go together.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "assessment/statistics/answer.h"
#include "assessment/statistics/data_table.h"
#include "assessment/statistics/procedure.h"

namespace seldinger::assessment::statistics {

// Adjusted p-values, in the order of the given.
std::vector<double> holm_adjusted(std::span<const double> p_values);
std::vector<double> bh_adjusted(std::span<const double> p_values);

struct MaxT {
  std::vector<double> t, raw, adjusted;  // of each outcome
  bool all = false;                      // all deals were gone through
};
// Welch's t of each outcome, step-down max |T| (Westfall, Young: Resampling-Based Multiple Testing, 1993, algorithm
// 4.1). outcomes[k][i] is of person i; each varies.
MaxT max_t_test(std::span<const std::vector<double>> outcomes, const std::vector<char>& is_first, std::size_t draws,
                std::uint64_t seed);

Answer holm(const DataTable& table, const ProcedureOptions& options);
Answer bh(const DataTable& table, const ProcedureOptions& options);
Answer max_t(const DataTable& table, const ProcedureOptions& options);

}  // namespace seldinger::assessment::statistics
