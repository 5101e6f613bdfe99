// Repeated values of persons: how they change with x, and how groups differ, with the person as the unit.
#pragma once

#include "assessment/statistics/answer.h"
#include "assessment/statistics/data_table.h"

namespace seldinger::assessment::statistics {

enum class RandomEffects { as_data_allow, intercept, slope };

struct MixedModelOptions {
  RandomEffects random = RandomEffects::as_data_allow;  // a slope where persons have four occasions, as a rule
  bool interaction = false;                             // a slope for each group
};
// value ~ x + group by REML. What bears the answer's estimate: the slope; without x the difference of two groups;
// else the mean.
Answer mixed_model(const DataTable& table, const MixedModelOptions& options);

// value (1: passed) ~ x + group with a random intercept per person, by adaptive Gauss–Hermite quadrature.
struct LogisticMixedOptions {
  std::size_t nodes = 25;  // 15 to 101
  bool interaction = false;
};
Answer logistic_mixed(const DataTable& table, const LogisticMixedOptions& options);

}  // namespace seldinger::assessment::statistics
