#include "assessment/statistics/reliability/two_way.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "sim/base/check.h"

namespace seldinger::assessment::statistics {

TwoWay two_way(const CompleteTable& table) {
  CHECK(table.rows >= 2 && table.columns.size() >= 2);
  const std::size_t n = table.rows, k = table.columns.size();
  TwoWay found;
  found.n = static_cast<double>(n);
  found.k = static_cast<double>(k);
  std::vector<double> of_subject(n), of_rater(k);
  double largest = 0.0;
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < k; ++j) {
      const double value = table.at(i, j);
      of_subject[i] += value / found.k;
      of_rater[j] += value / found.n;
      found.mean += value / (found.n * found.k);
      largest = std::max(largest, std::abs(value));
    }
  double subjects = 0.0, raters = 0.0, error = 0.0;
  for (const double mean : of_subject) subjects += found.k * (mean - found.mean) * (mean - found.mean);
  for (const double mean : of_rater) raters += found.n * (mean - found.mean) * (mean - found.mean);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < k; ++j) {
      const double off = table.at(i, j) - of_subject[i] - of_rater[j] + found.mean;
      error += off * off;
    }
  // What rounding alone makes of scores that do not differ.
  const double rounding = 1e-28 * largest * largest * found.n * found.k;
  for (double* sum : {&subjects, &raters, &error})
    if (*sum <= rounding) *sum = 0.0;
  found.ms_subjects = subjects / (found.n - 1.0);
  found.ms_raters = raters / (found.k - 1.0);
  found.ms_error = error / ((found.n - 1.0) * (found.k - 1.0));
  found.ms_within = (raters + error) / (found.n * (found.k - 1.0));
  found.sd = std::sqrt((subjects + raters + error) / (found.n * found.k - 1.0));
  found.sd_of_means = std::sqrt(found.ms_subjects / found.k);
  return found;
}

}  // namespace seldinger::assessment::statistics
