// A CSV file as the table that a statistical procedure takes: numbers of the columns asked for, and labels.
#pragma once

#include <string>
#include <vector>

#include "assessment/statistics/data_table.h"
#include "sim/base/result.h"

namespace seldinger::app {

// Columns by their names in the header; empty: not asked for.
struct TableColumns {
  std::vector<std::string> values;
  std::string group, subject, rater, x;

  bool any() const noexcept {
    return !(values.empty() && group.empty() && subject.empty() && rater.empty() && x.empty());
  }
};

struct ReadTable {
  assessment::statistics::DataTable table;
  std::vector<std::string> notes;  // what is odd about it, though it can be read
};

// Comma-separated; by semicolons or tabs where the header holds these and, outside of quotes, no comma. A
// byte-order mark, and columns beside those asked for, are let pass. Empty cells, NA and NaN are missing. A text
// without any line is a table without rows. Refused: `bad_csv` (no text in UTF-8, no CSV, a column that is missing
// or is there twice, a row of another length, no finite number; at most ten are told, by row, counted from 1 after
// the header, and column). Errors never hold what a cell holds: it may identify somebody.
base::Result<ReadTable> table_in_csv(const std::string& text, const TableColumns& columns);

// Columns side by side, a condition each and a person a row, as one value by subject and group: the columns' names
// are the groups. Rows without a label of `subject`, where there is one, stay without.
assessment::statistics::DataTable stacked(const assessment::statistics::DataTable& table);

// "a,b" as a header would have them: a name that holds a comma stands in quotes. Empty: it is no such list.
std::vector<std::string> column_names(const std::string& typed);

}  // namespace seldinger::app
