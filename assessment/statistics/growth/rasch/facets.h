// Answers of persons to items, judged by raters or not: a table becomes cells of whole scores from 0.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "assessment/statistics/data_table.h"

namespace seldinger::assessment::statistics {

// A cell is an item as one rater judges it; without raters there is one.
struct Facets {
  std::vector<std::string> items, raters, persons;
  std::vector<std::vector<int>> scores;  // of each person, a cell's score; −1: none. Cells: item · raters + rater
  int most = 0;                          // the highest score
  std::size_t missing = 0;
  const char* reason = nullptr;  // of reasons.h: why these are none
  const char* why = "";

  std::size_t cells() const noexcept { return items.size() * (raters.empty() ? 1 : raters.size()); }
  std::size_t item_of(std::size_t cell) const noexcept { return raters.empty() ? cell : cell / raters.size(); }
  std::size_t rater_of(std::size_t cell) const noexcept { return raters.empty() ? 0 : cell % raters.size(); }
};

// Each column of numbers is an item, or, where there is one column and groups, each group is one. A row is a person
// where none is named.
Facets facets_of(const DataTable& table);

// Takes away what no estimate can be made from: persons with the least or the greatest score that they could have,
// items and raters that are always scored 0 or always the highest, until nothing of the kind is left. What went
// comes back by name.
struct Extremes {
  std::vector<std::string> items, raters;
  std::vector<bool> person;  // of each, whether the score was extreme
};
Extremes without_extremes(Facets& facets);

}  // namespace seldinger::assessment::statistics
