// Two groups, two outcomes: Fisher's exact test with the conditional odds ratio, and the difference of shares.
#pragma once

#include <cstdint>
#include <optional>

#include "assessment/statistics/answer.h"
#include "assessment/statistics/data_table.h"
#include "assessment/statistics/procedure.h"

namespace seldinger::assessment::statistics {

// k1 of n1 in the first group, k2 of n2 in the second.
struct FourFold {
  std::int64_t k1 = 0, n1 = 0, k2 = 0, n2 = 0;
};

struct FisherExact {
  double p_value = 1.0;                       // tables no more probable than this one, two-sided
  std::optional<double> odds_ratio;           // by conditional maximum likelihood; nothing: without bound
  std::optional<double> odds_low, odds_high;  // 95 %, from two exact one-sided tests at 2.5 %
};
FisherExact fisher_exact_of(const FourFold& table);

// Values 0 and 1 by two groups.
Answer fisher_exact(const DataTable& table, const ProcedureOptions& options);

}  // namespace seldinger::assessment::statistics
