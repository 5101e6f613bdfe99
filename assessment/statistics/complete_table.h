// Scores as a full table: a row for each subject, a column for each rater, judge, case or item.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "assessment/statistics/answer.h"
#include "assessment/statistics/data_table.h"

namespace seldinger::assessment::statistics {

struct CompleteTable {
  std::vector<std::string> subjects;  // empty where nobody is named
  std::vector<std::string> columns;
  std::size_t rows = 0;
  std::vector<double> values;  // a subject's scores beside each other
  std::size_t missing = 0;     // subjects left out, since a score of theirs is missing
  // Of reasons.h, why there is no such table: nothing in it, a cell that is filled twice, values whose squares are
  // no numbers.
  const char* reason = nullptr;

  double at(std::size_t row, std::size_t column) const { return values[row * columns.size() + column]; }
  std::vector<double> column(std::size_t which) const;
};

// Where raters are named: the first column's values by subject and rater, in the order of their first rows. Else a
// row a subject and each column of numbers a column.
CompleteTable complete_table(const DataTable& table);
// Why a table has not `rows` subjects with `columns` scores; nullptr: it has.
const char* smaller_than(const CompleteTable& table, std::size_t rows, std::size_t columns);
// An answer that ends here, with how many subjects it had.
Answer refused_table(const char* test, const char* reason, const CompleteTable& table, const char* note = nullptr);

}  // namespace seldinger::assessment::statistics
