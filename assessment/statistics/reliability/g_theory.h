// Generalizability: how much of the scores' variance is the persons', how much the cases' and occasions', and how
// many cases a decision needs (Brennan, Generalizability Theory, 2001).
#pragma once

#include <cstddef>
#include <optional>

#include "assessment/statistics/answer.h"
#include "assessment/statistics/data_table.h"

namespace seldinger::assessment::statistics {

// Of a balanced random design of persons by cases, or by cases and occasions; 0 where the design has no such one.
// `rest` is the highest interaction together with chance.
struct VarianceComponents {
  double person = 0.0, cases = 0.0, occasion = 0.0;
  double person_case = 0.0, person_occasion = 0.0, case_occasion = 0.0, rest = 0.0;
};

// Of the mean over so many cases and occasions: E ρ² for ranking persons, Φ for a decision at a fixed cut. NaN
// where nothing varies.
double e_rho2(const VarianceComponents& of, double cases, double occasions);
double phi(const VarianceComponents& of, double cases, double occasions);
// The least number of cases that brings Φ, or E ρ² where `relative`, to `target`. Nothing: none does.
std::optional<double> cases_for(const VarianceComponents& of, double target, double occasions, bool relative);

// Values by person (subject) and case (rater), and by occasion where `x` is given. D-study rows for one case up;
// the target of Φ is what they are asked to reach.
Answer g_theory(const DataTable& table, double target);

}  // namespace seldinger::assessment::statistics
