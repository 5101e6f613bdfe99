// Ranks of several groups: Kruskal–Wallis with Dunn's pairs, Jonckheere's trend, Friedman's blocks.
#pragma once

#include <span>
#include <vector>

#include "assessment/statistics/answer.h"
#include "assessment/statistics/data_table.h"
#include "assessment/statistics/procedure.h"

namespace seldinger::assessment::statistics {

Answer kruskal(const DataTable& table, const ProcedureOptions& options);

struct DunnPair {
  std::size_t first = 0, second = 0;  // groups
  double z = 0.0, p_value = 1.0, p_holm = 1.0;
};
// Every pair of groups by mean ranks of all, variance corrected for ties (Dunn, Technometrics 6, 1964); z > 0 where
// the second is the higher.
std::vector<DunnPair> dunn_pairs(std::span<const Group> groups);
Answer dunn(const DataTable& table, const ProcedureOptions& options);

struct Trend {
  double j = 0.0, expected = 0.0, variance = 0.0, pairs = 0.0;

  double z() const;
};
// Groups in the order in which values are expected to rise (Jonckheere, Biometrika 41, 1954); ties are halves and
// taken off the variance.
Trend jonckheere_trend(std::span<const Group> groups);
Answer jonckheere(const DataTable& table, const ProcedureOptions& options);

// Persons are the blocks, the group column holds the conditions.
Answer friedman(const DataTable& table, const ProcedureOptions& options);

}  // namespace seldinger::assessment::statistics
