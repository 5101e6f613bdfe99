// Intraclass correlations: the share of the scores' variance that is between subjects, in the six forms of Shrout
// and Fleiss (Psychol. Bull. 86, 1979) with the intervals of McGraw and Wong (Psychol. Methods 1, 1996), and what
// one score is wrong by.
#pragma once

#include <array>

#include "assessment/statistics/answer.h"
#include "assessment/statistics/complete_table.h"
#include "assessment/statistics/reliability/two_way.h"

namespace seldinger::assessment::statistics {

struct IccForm {
  const char* name;   // as the option `form` names it
  const char* words;  // what it is, with its usual sign
};
// One-way, two-way random (agreement), two-way mixed (consistency), of one score and of the mean of all raters'.
inline constexpr std::array<IccForm, 6> kIccForms = {{
    {"icc1", "ICC(1): one-way random, one score"},
    {"icc2", "ICC(2,1): two-way random, absolute agreement, one score"},
    {"icc3", "ICC(3,1): two-way mixed, consistency, one score"},
    {"icc1k", "ICC(1,k): one-way random, mean of all raters"},
    {"icc2k", "ICC(2,k): two-way random, absolute agreement, mean of all raters"},
    {"icc3k", "ICC(3,k): two-way mixed, consistency, mean of all raters"},
}};

struct Icc {
  double value = 0.0;  // negative where scores of a subject differ more than subjects do; not clipped
  Interval ci95;
  double f = 0.0, df1 = 0.0, df2 = 0.0, p_value = 0.0;  // of no correlation, one-sided
};
// Under so many raters the F interval of agreement is too narrow where raters differ: it covers .90 with 100
// subjects and three raters, .72 at worst with two (tests/assessment/statistics/reliability).
inline constexpr double kEnoughRaters = 20.0;

// In the order of kIccForms. What is not defined, as where nobody differs from anybody, is NaN.
std::array<Icc, 6> iccs(const TwoWay& scores);

// Of agreement, of one score or of the mean of all raters', by pivotal quantities: covers where the F interval does
// not.
Interval pivotal_agreement_interval(const TwoWay& scores, bool of_mean);

// What a score is wrong by (standard error of measurement), and the least change of a person that is more than that
// in 95 of 100 (Weir, J. Strength Cond. Res. 19, 2005).
struct MeasurementError {
  double sem = 0.0, mdc95 = 0.0;
};
MeasurementError measurement_error(double sd, double reliability);

// `form`: an index of kIccForms.
Answer icc(const CompleteTable& table, std::size_t form);

}  // namespace seldinger::assessment::statistics
