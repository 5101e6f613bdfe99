// Planning: power, sample sizes, and the effect that a comparison would have found.
#pragma once

#include <cstddef>
#include <string>

#include "assessment/statistics/answer.h"
#include "assessment/statistics/data_table.h"
#include "assessment/statistics/procedure.h"

namespace seldinger::assessment::statistics {

inline constexpr double kAlpha = 0.05;         // two-sided, of every test of this shelf
inline constexpr double kPlannedPower = 0.80;  // at which detectable effects are said

// Power of the two-sided t-test of two groups whose means differ by d standard deviations.
double t_test_power(double n1, double n2, double d, double alpha);
// The part of it that finds the difference on its right side, d > 0: what R's power.t.test calls power.
double t_test_power_right(double n1, double n2, double d, double alpha);
// n of each group; not a whole number. NaN: there is none from 2 to 1e7.
double t_test_n(double d, double power, double alpha);
double t_test_detectable(double n1, double n2, double power, double alpha);
// How many standard errors a mean must lie off for a t-test of `df` to find it.
double detectable_errors(double df, double power, double alpha);
// Persons of both groups together for P(X < Y) = p, a share of them in the first (Noether, JASA 82, 1987).
double noether_total(double p, double share_of_first, double power, double alpha);
// P(X < Y) above ½ that a rank test finds whose estimate of it has the standard error `error` when nothing differs.
double detectable_probability(double error, double power, double alpha);
// How large Cohen's f must be for one-way analysis of variance.
double detectable_f(double groups, double total, double power, double alpha);
// Non-centrality that a χ² test of `df` finds.
double detectable_noncentrality(double df, double power, double alpha);

// Adds the number as `name`, and to an answer that is not significant the sentence that `effect` of that size would
// have been found; where `most` is passed, that no effect would.
void say_detectable(Answer& answer, const std::string& name, const std::string& effect, double value, double most);

// Which of n, d and power is missing in the options; with p (P(X < Y)) by Noether.
Answer power(const DataTable& table, const ProcedureOptions& options);

}  // namespace seldinger::assessment::statistics
