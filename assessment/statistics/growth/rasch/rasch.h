// Difficulty of items, severity of raters and ability of persons on one scale.
#pragma once

#include "assessment/statistics/answer.h"
#include "assessment/statistics/data_table.h"

namespace seldinger::assessment::statistics {

inline constexpr std::size_t kLeastPersonsOfRasch = 30;

// The dichotomous Rasch model; with scores above 1 the rating scale model; with raters its many-facet form. Each
// column is an item, or each group of one column. Rows are items, raters and persons with their place in logits:
// what a Wright map draws.
Answer rasch(const DataTable& table);

}  // namespace seldinger::assessment::statistics
