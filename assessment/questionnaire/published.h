// What a published mean and standard deviation of an item tell of who answered it: how many can have answered, and
// what they can have said. The tables of the thesis' three workshops are here as they were printed.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "assessment/questionnaire/form.h"

namespace seldinger::assessment::questionnaire {

// As printed, with its decimals; empty: the table says N.A.
struct PublishedSummary {
  std::string_view table;    // "6.2"
  std::string_view form_id;  // of shipped_forms.h
  std::string_view item;
  std::string_view group;
  std::size_t group_size;  // as the caption has it
  std::string_view mean, sd;
  // The least and the most answer, where the text says them.
  std::optional<int> least{}, most{};
};
std::span<const PublishedSummary> thesis_summaries();  // by table, item and group

enum class Reconstruction {
  determined,  // one set of answers alone has this mean and this SD
  one_of_many,
  none  // no set of answers has them, or the search for one was given up
};

struct SummaryReading {
  PublishedSummary published;
  const Item* item = nullptr;
  // How many of the group can have answered, in whole numbers; where none can, and the item is a number or a mark
  // between two points of a scale, in halves.
  std::vector<std::size_t> possible_n;
  bool halves = false;
  // Of `possible_n` the group's size, else the greatest.
  std::size_t n = 0;
  Reconstruction reconstruction = Reconstruction::none;
  std::size_t sets = 0;            // of n answers, found
  bool all_sets = true;            // false: there are more
  std::vector<double> answers;     // ascending; one set of them
  std::optional<double> mean, sd;  // of `answers`

  bool n_is_certain() const { return possible_n.size() == 1; }
};
// None where the table says N.A.
std::optional<SummaryReading> read_summary(const PublishedSummary& published);
// All that have numbers, read once.
const std::vector<SummaryReading>& thesis_readings();

// "5.40" to as many decimals as `printed` has: whether a number would be printed so.
bool is_printed_as(double value, std::string_view printed);

}  // namespace seldinger::assessment::questionnaire
