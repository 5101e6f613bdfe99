// Counts per person (needle passes, no-go contacts) in two groups: the ratio of their rates, by Poisson's
// distribution exactly, or with persons that differ, by the negative binomial.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "assessment/statistics/answer.h"
#include "assessment/statistics/data_table.h"
#include "assessment/statistics/procedure.h"

namespace seldinger::assessment::statistics {

struct PoissonRatio {
  double p_value = 1.0;         // counts no more probable, two-sided
  std::optional<double> ratio;  // nothing: the second group has no event
  double low = 0.0;
  std::optional<double> high;
};
// Counts k1 and k2 under exposures above 0; k1 + k2 above 0.
PoissonRatio poisson_ratio(std::int64_t k1, double exposure1, std::int64_t k2, double exposure2);

// Persons of one group: counts and what each was exposed to.
struct Counted {
  std::vector<double> counts, exposures;
};
struct NegativeBinomial {
  double log_ratio = 0.0, standard_error = 0.0;
  std::optional<double> theta;  // variance = µ + µ²/θ; nothing: persons do not differ more than by chance
};
// By maximum likelihood with one θ; both groups have an event.
NegativeBinomial negative_binomial_of(const Counted& first, const Counted& second);

// Values are counts by two groups; x, where given, what each person was exposed to.
Answer poisson(const DataTable& table, const ProcedureOptions& options);
Answer negative_binomial(const DataTable& table, const ProcedureOptions& options);

}  // namespace seldinger::assessment::statistics
