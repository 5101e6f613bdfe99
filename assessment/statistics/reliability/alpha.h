// Whether items of a scale hang together: Cronbach's alpha with Feldt's interval, Guttman's bounds, and what each
// item does to it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "assessment/statistics/answer.h"
#include "assessment/statistics/complete_table.h"

namespace seldinger::assessment::statistics {

// The ends of the items' scale, and which items run against it.
struct ItemScale {
  std::optional<double> low, high;
  std::vector<std::string> reverse;
};
// Turns the items round that run against the scale. What is wrong with the scale, in words; empty: nothing, and
// `items` is turned.
std::string turn_items(CompleteTable& items, const ItemScale& scale);
// Takes out the items whose answers do not vary. Their names.
std::vector<std::string> drop_constant_items(CompleteTable& items);
// "q3, q7 do not vary and are left out."; empty for no names.
std::string said_of_constant_items(const std::vector<std::string>& names);

// Of at least two items and two persons.
double cronbach_alpha(const CompleteTable& items);

Answer alpha(CompleteTable items, const ItemScale& scale);

}  // namespace seldinger::assessment::statistics
