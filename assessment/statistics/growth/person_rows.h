// Rows of repeated persons as mixed models take them: value, standardised x, group, person; and the fixed effects'
// columns with the weights that turn their estimates back into the units given.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "assessment/statistics/data_table.h"

namespace seldinger::assessment::statistics {

struct PersonRows {
  std::vector<double> y;
  std::vector<double> x;  // empty: none was given
  std::vector<std::size_t> group, person;
  std::vector<std::string> groups;
  std::size_t persons = 0, missing = 0;
  std::size_t repeated = 0;   // persons with more than one row
  std::size_t occasions = 0;  // different x of a person, the median over persons
  bool group_within = false;  // somebody stands in more than one group

  std::size_t rows() const noexcept { return y.size(); }
};
PersonRows person_rows(const DataTable& table);

// Columns: 1, x, each group but the first, and with `interaction` x within each of these; x as (x − centre) / size.
struct FixedEffects {
  std::size_t columns = 0;
  std::vector<double> matrix;  // `columns` numbers a row
  std::vector<std::string> names;
  double centre = 0.0, size = 1.0;
  std::size_t columns_with_x = 0;
  // A row for each name: the effect in the units of x, as a sum of those of the columns.
  std::vector<std::vector<double>> weights;
};
// CHECKs that x varies where there is one.
FixedEffects fixed_effects(const PersonRows& rows, bool interaction);
// Whether no column follows from the others.
bool told_apart(const FixedEffects& effects);

}  // namespace seldinger::assessment::statistics
