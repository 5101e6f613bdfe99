// What a procedure is given: numbers in named columns, and to whom and to what each row belongs.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "assessment/statistics/answer.h"

namespace seldinger::assessment::statistics {

struct Column {
  std::string name;
  std::vector<double> values;  // one a row; NaN: missing
};

// One observation a row. Vectors of labels and `x` are empty where they were not given; a label without letters, as
// a NaN, is missing.
struct DataTable {
  std::size_t rows = 0;
  std::vector<Column> values;
  std::vector<std::string> group, subject, rater;
  std::vector<double> x;  // a second number: time, dose, event, predictor
};

struct Group {
  std::string name;
  std::vector<double> values;
};

// The first column's values by group, in the order `order` where it names them, else in that of their first row;
// rows with something missing are left out and counted. Where a person is named, the person is the unit: nobody
// twice in a group, nobody in two.
struct IndependentGroups {
  std::vector<Group> groups;
  std::size_t missing = 0;
  std::size_t n = 0;
  const char* reason = nullptr;  // of reasons.h: why these are no independent groups

  std::vector<GroupCount> counts() const;
};
IndependentGroups independent_groups(const DataTable& table, const std::vector<std::string>& order = {});

// Without what is missing.
std::vector<double> present(const std::vector<double>& values);

}  // namespace seldinger::assessment::statistics
