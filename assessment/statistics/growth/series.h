// A person's values in their order: what curves and charts of learning are drawn from.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "assessment/statistics/data_table.h"

namespace seldinger::assessment::statistics {

struct Series {
  std::string person;
  std::vector<double> x;  // 1, 2, 3 … where the table has none
  std::vector<double> values;
};

// The first column's values by person, in the order of their first row; all are one person's where none is named. A
// person's values are in the order of x, of equal x in that of their rows. Rows with something missing are left out
// and counted.
struct PersonsSeries {
  std::vector<Series> persons;
  std::size_t missing = 0;
  std::size_t values = 0;
};
PersonsSeries persons_series(const DataTable& table);

}  // namespace seldinger::assessment::statistics
