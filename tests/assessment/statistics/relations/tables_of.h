// Tables for the tests of relations, and answers' numbers by name.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "assessment/statistics/answer.h"
#include "assessment/statistics/data_table.h"
#include "assessment/statistics/procedure.h"
#include "assessment/statistics/relations/relations_procedures.h"
#include "sim/base/rng.h"

namespace seldinger::fixtures {

using assessment::statistics::Answer;
using assessment::statistics::DataTable;
using assessment::statistics::Procedure;
using assessment::statistics::ProcedureOptions;

inline constexpr double kMissing = std::numeric_limits<double>::quiet_NaN();

inline const Procedure& procedure_named(std::string_view name) {
  for (const Procedure& one : assessment::statistics::relations_procedures())
    if (one.name == name) return one;
  ADD_FAILURE() << "there is no procedure " << name;
  return assessment::statistics::relations_procedures().front();
}

inline Answer answer_of(std::string_view name, const DataTable& table,
                        std::map<std::string, std::string> options = {}) {
  return procedure_named(name).run(table, ProcedureOptions(std::move(options)));
}

// Values a group after the other, groups named a, b, c.
inline DataTable grouped(const std::vector<std::vector<double>>& groups, const std::vector<double>& x = {}) {
  DataTable table;
  table.values.push_back({"value", {}});
  for (std::size_t g = 0; g < groups.size(); ++g)
    for (const double value : groups[g]) {
      table.values[0].values.push_back(value);
      table.group.emplace_back(1, static_cast<char>('a' + g));
      ++table.rows;
    }
  table.x = x;
  return table;
}

inline DataTable related(const std::vector<double>& values, const std::vector<double>& x) {
  DataTable table;
  table.rows = values.size();
  table.values.push_back({"value", values});
  table.x = x;
  return table;
}

// NaN where there is no such number.
inline double named(const Answer& answer, std::string_view name) {
  for (const auto& one : answer.more)
    if (one.name == name) return one.value;
  return kMissing;
}

// Fails on NaN. What cancels to nothing is compared to fourteen places.
inline void expect_near_relative(double got, double want, double tolerance, const std::string& what) {
  EXPECT_LE(std::abs(got - want), tolerance * std::abs(want) + 1e-14) << what << ": " << got << ", not " << want;
}
inline double or_missing(const std::optional<double>& value) {
  return value.value_or(kMissing);
}
inline double low_of(const Answer& answer) {
  return answer.ci95 ? answer.ci95->low : kMissing;
}
inline double high_of(const Answer& answer) {
  return answer.ci95 ? answer.ci95->high : kMissing;
}

}  // namespace seldinger::fixtures
