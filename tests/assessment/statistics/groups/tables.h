// Tables of values as this shelf's tests make them, and what they look for in an answer.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "assessment/statistics/answer.h"
#include "assessment/statistics/data_table.h"
#include "assessment/statistics/groups/groups_procedures.h"
#include "assessment/statistics/procedure.h"

namespace seldinger::assessment::statistics {

inline DataTable table_of(const std::vector<double>& values) {
  DataTable table;
  table.rows = values.size();
  table.values = {{"value", values}};
  return table;
}

inline DataTable table_of(const std::vector<Group>& groups) {
  DataTable table = table_of(std::vector<double>());
  for (const Group& group : groups)
    for (const double value : group.values) {
      table.values[0].values.push_back(value);
      table.group.push_back(group.name);
      ++table.rows;
    }
  return table;
}

// Persons p0, p1, … under each condition; the k-th value of a condition is the k-th person's.
inline DataTable table_of_persons(const std::vector<Group>& conditions) {
  DataTable table = table_of(conditions);
  for (const Group& condition : conditions)
    for (std::size_t i = 0; i < condition.values.size(); ++i) table.subject.push_back("p" + std::to_string(i));
  return table;
}

inline ProcedureOptions with(std::map<std::string, std::string> options) {
  return ProcedureOptions(std::move(options));
}

inline double more(const Answer& answer, const std::string& name) {
  for (const Named& one : answer.more)
    if (one.name == name) return one.value;
  ADD_FAILURE() << answer.test << " has no " << name << ": " << answer.reason;
  return std::nan("");
}

inline double in_row(const Answer& answer, const std::string& row, const std::string& name) {
  for (const Row& one : answer.rows)
    if (one.name == row)
      for (const Named& value : one.values)
        if (value.name == name) return value.value;
  ADD_FAILURE() << answer.test << " has no " << name << " of " << row << ": " << answer.reason;
  return std::nan("");
}

// Relative, or absolute below 1; a NaN is not close to anything.
inline void expect_close(double got, double want, double tolerance, const std::string& what) {
  EXPECT_TRUE(std::abs(got - want) <= tolerance * std::max(1.0, std::abs(want)))
      << what << ": " << testing::PrintToString(got) << ", not " << testing::PrintToString(want);
}
inline void expect_close(std::optional<double> got, double want, double tolerance, const std::string& what) {
  ASSERT_TRUE(got.has_value()) << what;
  expect_close(*got, want, tolerance, what);
}
inline void expect_close(const std::optional<Interval>& got, const Interval& want, double tolerance,
                         const std::string& what) {
  ASSERT_TRUE(got.has_value()) << what;
  expect_close(got->low, want.low, tolerance, what + ", low");
  expect_close(got->high, want.high, tolerance, what + ", high");
}

}  // namespace seldinger::assessment::statistics
