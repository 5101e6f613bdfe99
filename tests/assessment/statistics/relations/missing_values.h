// Two groups with values that are missing: tables, and how often imputed comparisons hold what is true.
#pragma once

#include <cmath>
#include <cstddef>
#include <limits>
#include <string>

#include "assessment/statistics/relations/imputation.h"
#include "sim/base/rng.h"

namespace seldinger::fixtures {

// Groups a and b of `each`, y = 10 + 2·(b) + 0.8·x + 0.6·noise, both of SD 1 about x; of those with x below the
// middle so many lack y, in b three times fewer: who has a value is no fair sample of a group.
inline assessment::statistics::DataTable half_missing(base::Rng& rng, std::size_t each, bool with_x, double share) {
  assessment::statistics::DataTable table;
  table.values.push_back({"y", {}});
  for (const char* group : {"a", "b"})
    for (std::size_t i = 0; i < each; ++i) {
      const bool is_b = group[0] == 'b';
      const double x = rng.normal(), y = 10.0 + (is_b ? 2.0 : 0.0) + 0.8 * x + 0.6 * rng.normal();
      const bool missing = rng.uniform() < (x < 0.0 ? (is_b ? share / 3.0 : share) : 0.0);
      table.values.front().values.push_back(missing ? std::numeric_limits<double>::quiet_NaN() : y);
      table.x.push_back(x);
      table.group.emplace_back(group);
      ++table.rows;
    }
  if (!with_x) table.x.clear();
  return table;
}

struct Imputed {
  double covered = 0.0, bias = 0.0, covered_by_present = 0.0;
  std::size_t runs = 0;
};
// Of b − a, which is 2; three in five of a with a low x are missing. `covered_by_present`: of imputation that is
// not told x.
inline Imputed imputed_coverage(base::Rng& rng, std::size_t each, std::size_t runs) {
  Imputed found;
  std::size_t held = 0, held_by_present = 0;
  for (std::size_t run = 0; run < runs; ++run) {
    assessment::statistics::DataTable table = half_missing(rng, each, true, 0.6);
    const assessment::statistics::ProcedureOptions options(
        {{"order", "b:a"}, {"draws", "20"}, {"seed", std::to_string(run)}});
    const auto given_x = assessment::statistics::imputed(table, options);
    table.x.clear();
    const auto without = assessment::statistics::imputed(table, options);
    if (!given_x.ci95 || !without.ci95) continue;
    ++found.runs;
    found.bias += *given_x.estimate - 2.0;
    held += given_x.ci95->low <= 2.0 && 2.0 <= given_x.ci95->high ? 1 : 0;
    held_by_present += without.ci95->low <= 2.0 && 2.0 <= without.ci95->high ? 1 : 0;
  }
  const auto n = static_cast<double>(found.runs);
  found.covered = static_cast<double>(held) / n;
  found.covered_by_present = static_cast<double>(held_by_present) / n;
  found.bias /= n;
  return found;
}

}  // namespace seldinger::fixtures
