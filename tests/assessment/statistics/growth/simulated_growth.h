// Persons who grow: simulated tables with a planted truth, and the same as a data frame of R.
#pragma once

#include <string>

#include "assessment/statistics/data_table.h"
#include "sim/base/rng.h"
#include "tests/assessment/statistics/r_oracle.h"

namespace seldinger::fixtures {

// y = 50 − 2·x + 3·(number of the group) + a person's own level (SD 6) and slope (SD 1 unless given) + noise (SD
// 4), x = 0, 1 …; a quarter of the attempts was not made, a twentieth of the values is missing.
inline assessment::statistics::DataTable unbalanced_growth(base::Rng& rng, std::size_t persons,
                                                           std::size_t attempts, std::size_t groups,
                                                           double slope = -2.0, double slopes_sd = 1.0) {
  assessment::statistics::DataTable table;
  table.values.push_back({"y", {}});
  for (std::size_t person = 0; person < persons; ++person) {
    const std::size_t group = person % groups;
    const double level = 50.0 + 6.0 * rng.normal() + 3.0 * static_cast<double>(group),
                 own = slope + slopes_sd * rng.normal();
    for (std::size_t k = 0; k < attempts; ++k) {
      if (rng.uniform() < 0.25) continue;
      const double x = static_cast<double>(k), y = level + own * x + 4.0 * rng.normal();
      table.values.front().values.push_back(rng.uniform() < 0.05 ? std::nan("") : y);
      table.x.push_back(x);
      table.subject.push_back("p" + std::to_string(person));
      if (groups > 1) table.group.push_back("g" + std::to_string(group));
      ++table.rows;
    }
  }
  return table;
}

// d with the columns y, x, s and g, without rows whose y is missing; levels of g in the order of the rows that are
// left, as ours are.
inline std::string r_table(const assessment::statistics::DataTable& table) {
  const auto words = [](const std::vector<std::string>& labels) {
    std::string text = "c(";
    for (const std::string& one : labels) text += (text.size() > 2 ? ",'" : "'") + one + "'";
    return text + ")";
  };
  std::string text = "d <- data.frame(y = " + r_vector(table.values.front().values) + ", x = " + r_vector(table.x) +
                     ", s = " + words(table.subject) + ")\n";
  if (!table.group.empty()) text += "d$g <- " + words(table.group) + "\n";
  text += "d <- d[!is.na(d$y), ]\n";
  return table.group.empty() ? text : text + "d$g <- factor(d$g, levels = unique(d$g))\n";
}

}  // namespace seldinger::fixtures
