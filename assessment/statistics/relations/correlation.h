// How two measurements of the same persons go together: Pearson's r, Spearman's ρ, Kendall's τb, each with test and
// interval, raw and corrected for what the measurements' own unreliability hides.
#pragma once

#include <optional>
#include <span>

#include "assessment/statistics/answer.h"
#include "assessment/statistics/data_table.h"
#include "assessment/statistics/procedure.h"

namespace seldinger::assessment::statistics {

// Product-moment correlation of two samples of equal length; NaN where one does not vary.
double correlation_coefficient(std::span<const double> a, std::span<const double> b);
// The same of their mid-ranks: Spearman's ρ.
double rank_correlation(std::span<const double> a, std::span<const double> b);

// tanh(artanh r ± 1.96 SE), 95 %: Fisher's for Pearson (SE² = 1/(n − 3)), Bonett and Wright's for Spearman
// ((1 + ρ²/2)/(n − 3)) and Kendall (.437/(n − 4)). Nothing where n is too small or |r| is 1.
std::optional<Interval> fisher_z_interval(double r, double standard_error);

// Columns: value and x.
Answer pearson(const DataTable& table, const ProcedureOptions& options);
Answer spearman(const DataTable& table, const ProcedureOptions& options);
Answer kendall(const DataTable& table, const ProcedureOptions& options);

}  // namespace seldinger::assessment::statistics
