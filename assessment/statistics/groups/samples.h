// What the procedures of this shelf make of a table before they compute, and what they say in common.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "assessment/statistics/answer.h"
#include "assessment/statistics/data_table.h"
#include "assessment/statistics/procedure.h"

namespace seldinger::assessment::statistics {

// Independent groups as a procedure wants them. Rows of groups that the option `order` does not name are left out;
// a note says so.
struct GroupsAsked {
  IndependentGroups groups;
  std::vector<std::string> notes;
  const char* reason = nullptr;  // of reasons.h

  Answer refused(const char* test) const;
  // The answer with n, groups, missing and notes of these groups.
  Answer answer(const char* test, std::string method) const;
};
// Exactly two with at least `least` values each.
GroupsAsked two_groups(const DataTable& table, const ProcedureOptions& options, std::size_t least);
// Two or more.
GroupsAsked several_groups(const DataTable& table, const ProcedureOptions& options, std::size_t least);

// Persons under each of the conditions that the group column names: value[person][condition].
struct Blocks {
  std::vector<std::string> conditions;
  std::vector<std::vector<double>> values;
  std::size_t missing = 0;  // persons left out: a condition of theirs is missing
  std::vector<std::string> notes;
  const char* reason = nullptr;

  Answer refused(const char* test) const;
  Answer answer(const char* test, std::string method) const;
};
Blocks complete_blocks(const DataTable& table, const ProcedureOptions& options);
// The same with exactly two conditions; their differences first − second.
struct Pairs {
  Blocks blocks;
  std::vector<double> differences;
};
Pairs complete_pairs(const DataTable& table, const ProcedureOptions& options, std::size_t least);

Answer bad_option(const char* test, const std::string& note);
// What the option holds where it is a number from `low` to `high`; nothing: it is none.
std::optional<double> number_within(const ProcedureOptions& options, const char* name, double fallback, double low,
                                    double high);

// "0.0281", as notes say numbers.
std::string in_words(double value);
// Two-sided p of a standard normal.
double two_sided_normal(double z);

}  // namespace seldinger::assessment::statistics
