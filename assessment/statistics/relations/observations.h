// The rows of a table on which all that a procedure asks for is there, each person once.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "assessment/statistics/answer.h"
#include "assessment/statistics/data_table.h"
#include "assessment/statistics/procedure.h"

namespace seldinger::assessment::statistics {

struct Wanted {
  std::size_t columns = 1;
  bool x = false;      // rows without x are left out; an x that is not given is no reason to
  bool group = false;  // likewise
};

struct Observations {
  std::vector<std::vector<double>> values;  // by column
  std::vector<double> x;                    // empty unless wanted and given
  std::vector<std::size_t> group;           // in `groups`; 0 where there are none
  std::vector<std::string> groups;
  std::size_t n = 0, missing = 0;
  const char* reason = nullptr;  // of reasons.h: why nothing can be made of them
  std::vector<std::string> notes;

  std::vector<GroupCount> counts() const;
  std::vector<double> values_of(std::size_t which_group, std::size_t column = 0) const;
  std::vector<double> x_of(std::size_t which_group) const;
};

// Groups stand in the order of their first row, or, where the option `order` names some, in that order and without
// the others.
Observations observations(const DataTable& table, const Wanted& wanted, const ProcedureOptions& options = {});

// Why these are not two groups of at least `least` each; nullptr: they are.
const char* not_two_groups(const Observations& rows, std::size_t least);
// Whether values are what a procedure counts: 0 or 1 each; whole numbers from 0 to 1e9.
bool all_zero_or_one(const std::vector<double>& values);
bool all_counts(const std::vector<double>& values);

// Says, where groups (the smallest counts for all) make up less than `enough` persons, what simulation found: that
// intervals hold the truth in less than 93 of 100 samples; that the test rejects more than 6 of 100 true
// equalities. tests/assessment/statistics/relations/*_long_test.cpp measure both.
void warn_of_interval(Answer& answer, std::size_t enough);
void warn_of_test(Answer& answer, std::size_t enough);

// What every answer begins with, and one that ends there.
Answer begun(const char* test, const Observations& rows);
Answer refused(const char* test, const char* reason, const Observations& rows, const char* note = nullptr);

}  // namespace seldinger::assessment::statistics
