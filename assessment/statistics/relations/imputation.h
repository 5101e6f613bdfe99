// Two means compared where some persons have no value: what is missing is drawn many times from what others of the
// same group show, given a second number where there is one, and the comparisons are pooled (Rubin, Multiple
// Imputation for Nonresponse in Surveys, 1987).
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "assessment/statistics/answer.h"
#include "assessment/statistics/data_table.h"
#include "assessment/statistics/procedure.h"

namespace seldinger::assessment::statistics {

inline constexpr std::size_t kLeastImputations = 10, kMostImputations = 500, kUsualImputations = 50;

// Estimates of one number from completed tables, as one (Rubin 1987; degrees of freedom by Barnard and Rubin,
// Biometrika 86, 1999).
struct Pooled {
  double estimate = 0.0;
  double within = 0.0, between = 0.0;  // variances: of an estimate, and of the estimates
  double total = 0.0;                  // within + (1 + 1/m)·between
  double df = 0.0;
};
// At least two, none of them without variance; `complete_df`: what an estimate of a whole table has.
Pooled pooled(std::span<const double> estimates, std::span<const double> variances, double complete_df);

struct ImputedComparison {
  Answer answer;
  std::vector<std::size_t> rows;           // of the table: whose value is missing
  std::vector<std::vector<double>> draws;  // by draw: a value for each of `rows`
};
// The first column's values by two groups, first − second, each completed table by Welch. Within a group values are
// normal, on a line over x where x is known of those who lack a value; its parameters are drawn too, from their
// posterior under a flat prior. Options `order`, `draws` and `seed`.
ImputedComparison imputed_comparison(const DataTable& table, const ProcedureOptions& options);
Answer imputed(const DataTable& table, const ProcedureOptions& options);

}  // namespace seldinger::assessment::statistics
