#include "app/cli/csv.h"

#include <string_view>

#include "app/cli/arguments.h"

namespace seldinger::app {
namespace {

constexpr std::size_t kMaxProblems = 10;

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && (text.front() == ' ' || text.front() == '\t' || text.front() == '"'))
    text.remove_prefix(1);
  while (!text.empty() && (text.back() == ' ' || text.back() == '\t' || text.back() == '\r' || text.back() == '"'))
    text.remove_suffix(1);
  return text;
}

void split(std::string_view line, std::vector<std::string_view>& cells) {
  cells.clear();
  for (;;) {
    const std::size_t comma = line.find(',');
    cells.push_back(trimmed(line.substr(0, comma)));
    if (comma == std::string_view::npos) return;
    line.remove_prefix(comma + 1);
  }
}

std::string_view take_line(std::string_view& rest) {
  const std::size_t end = rest.find('\n');
  const std::string_view line = rest.substr(0, end);
  rest.remove_prefix(end == std::string_view::npos ? rest.size() : end + 1);
  return line;
}

}  // namespace

base::Result<CsvRows> rows_in_csv(const std::string& text, std::span<const char* const> numbers,
                                  const char* label) {
  base::Error error{"bad_csv", "", {}};
  const auto bad = [&error](const std::string& what) { error.findings.push_back({"bad_csv", what}); };
  std::string_view rest = text;
  if (rest.substr(0, 3) == "\xef\xbb\xbf") rest.remove_prefix(3);
  std::vector<std::string_view> cells;
  split(take_line(rest), cells);
  const std::size_t width = cells.size();
  const auto place_of = [&](const char* name) {
    std::size_t place = 0, found = 0;
    for (std::size_t i = 0; i < width; ++i)
      if (cells[i] == name) {
        place = i;
        ++found;
      }
    if (found != 1) bad(std::string("column ") + name + (found == 0 ? " is missing" : " is there twice"));
    return place;
  };
  std::vector<std::size_t> places;
  for (const char* name : numbers) places.push_back(place_of(name));
  const std::size_t label_place = label == nullptr ? 0 : place_of(label);
  const bool header_is_good = error.findings.empty();

  CsvRows rows{numbers.size(), {}, {}};
  std::size_t row = 0;
  while (!rest.empty() && error.findings.size() < kMaxProblems) {
    const std::string_view line = take_line(rest);
    if (trimmed(line).empty()) continue;
    ++row;
    split(line, cells);
    if (cells.size() != width) {
      bad("row " + std::to_string(row) + " has another number of cells than the header");
      continue;
    }
    if (!header_is_good) continue;
    for (std::size_t c = 0; c < places.size() && error.findings.size() < kMaxProblems; ++c) {
      const auto number = parse_number(std::string(cells[places[c]]));
      if (!number) bad("row " + std::to_string(row) + ", " + numbers[c] + " is not a number");
      rows.values.push_back(number.value_or(0.0));
    }
    if (label != nullptr) rows.labels.emplace_back(cells[label_place]);
  }
  if (error.findings.empty() && row == 0) bad("there is no row");
  if (error.findings.empty()) return rows;
  error.text = error.findings.front().text;
  error.findings.erase(error.findings.begin());
  return error;
}

}  // namespace seldinger::app
