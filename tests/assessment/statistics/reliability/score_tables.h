// Tables of scores as `seldinger stats` reads them, for tests.
#pragma once

#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "assessment/statistics/complete_table.h"
#include "assessment/statistics/data_table.h"
#include "sim/base/rng.h"

namespace seldinger::fixtures {

using Rows = std::vector<std::vector<double>>;

// A column of numbers for each rater or item.
inline assessment::statistics::DataTable wide_table(const Rows& rows) {
  assessment::statistics::DataTable table;
  table.rows = rows.size();
  for (std::size_t j = 0; j < rows.front().size(); ++j) {
    table.values.push_back({"q" + std::to_string(j + 1), {}});
    for (const auto& row : rows) table.values.back().values.push_back(row[j]);
  }
  return table;
}

// A row for each subject and rater.
inline assessment::statistics::DataTable long_table(const Rows& rows) {
  assessment::statistics::DataTable table;
  table.values.push_back({"score", {}});
  for (std::size_t i = 0; i < rows.size(); ++i)
    for (std::size_t j = 0; j < rows[i].size(); ++j) {
      table.values.front().values.push_back(rows[i][j]);
      table.subject.push_back("s" + std::to_string(i));
      table.rater.push_back("r" + std::to_string(j));
    }
  table.rows = table.subject.size();
  return table;
}

inline assessment::statistics::CompleteTable scores(const Rows& rows) {
  return complete_table(wide_table(rows));
}

// What a person's skill, a rater's leniency and chance make; where `whole`, as whole numbers, so that scores tie.
inline Rows random_scores(std::uint64_t seed, std::size_t subjects, std::size_t raters, double sd_subject,
                          double sd_rater, double sd_error, bool whole) {
  base::Rng rng(seed);
  std::vector<double> leniency;
  for (std::size_t j = 0; j < raters; ++j) leniency.push_back(sd_rater * rng.normal());
  Rows rows;
  for (std::size_t i = 0; i < subjects; ++i) {
    const double skill = sd_subject * rng.normal();
    rows.emplace_back();
    for (std::size_t j = 0; j < raters; ++j) {
      const double score = 5.0 + skill + leniency[j] + sd_error * rng.normal();
      rows.back().push_back(whole ? std::round(score) : score);
    }
  }
  return rows;
}

inline double number_of(const assessment::statistics::Answer& answer, const std::string& name) {
  for (const auto& one : answer.more)
    if (one.name == name) return one.value;
  return std::nan("");
}

inline double number_of(const assessment::statistics::Row& row, const std::string& name) {
  for (const auto& one : row.values)
    if (one.name == name) return one.value;
  return std::nan("");
}

}  // namespace seldinger::fixtures
