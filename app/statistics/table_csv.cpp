#include "app/statistics/table_csv.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string_view>

#include "app/cli/arguments.h"
#include "app/cli/words.h"
#include "app/statistics/csv_records.h"
#include "app/statistics/look_alike.h"
#include "casedb/database/utf8.h"
#include "sim/base/ascii.h"

namespace seldinger::app {
namespace {

using assessment::statistics::DataTable;

constexpr std::size_t kMostProblems = 10;

// The first line decides, and only where it leaves no doubt.
char separator_of(std::string_view text) {
  bool quoted = false, semicolon = false, tab = false;
  for (const char c : text) {
    if (c == '"') quoted = !quoted;
    if (quoted) continue;
    if (c == ',') return ',';
    if (c == '\n' || c == '\r') break;
    semicolon = semicolon || c == ';';
    tab = tab || c == '\t';
  }
  if (semicolon == tab) return ',';
  return semicolon ? ';' : '\t';
}

bool is_missing(const std::string& cell) {
  const std::string small = base::lower(cell);
  return small.empty() || small == "na" || small == "nan";
}

// The columns asked for, where they stand, and what was read of them.
class TableReader {
 public:
  explicit TableReader(const TableColumns& columns) : columns_(columns) {
    for (const std::string& name : columns.values) read_.table.values.push_back({name, {}});
  }

  // False: the rows cannot be read.
  bool take_header(const std::vector<std::string>& header) {
    width_ = header.size();
    for (const std::string& name : columns_.values) value_places_.push_back(place_of(name, header));
    const auto place = [&](const std::string& name) {
      return name.empty() ? std::nullopt : std::optional(place_of(name, header));
    };
    group_ = place(columns_.group);
    subject_ = place(columns_.subject);
    rater_ = place(columns_.rater);
    x_ = place(columns_.x);
    return error_.findings.empty();
  }

  // False: enough is wrong.
  bool take_row(const std::vector<std::string>& cells) {
    DataTable& table = read_.table;
    const std::string row = "row " + std::to_string(++table.rows);
    if (cells.size() != width_) {
      bad(row + " has " + std::to_string(cells.size()) + " cells, the header " + std::to_string(width_));
      return error_.findings.size() < kMostProblems;
    }
    for (std::size_t i = 0; i < value_places_.size(); ++i)
      table.values[i].values.push_back(number(cells[value_places_[i]], row, columns_.values[i]));
    if (x_) table.x.push_back(number(cells[*x_], row, columns_.x));
    const auto keep = [&cells](const std::optional<std::size_t>& place, std::vector<std::string>& labels) {
      if (place) labels.push_back(is_missing(cells[*place]) ? std::string() : cells[*place]);
    };
    keep(group_, table.group);
    keep(subject_, table.subject);
    keep(rater_, table.rater);
    return error_.findings.size() < kMostProblems;
  }

  void bad(const std::string& what) {
    if (error_.findings.size() < kMostProblems) error_.findings.push_back({"bad_csv", what});
  }
  std::size_t rows() const noexcept { return read_.table.rows; }

  base::Result<ReadTable> finish() {
    if (error_.findings.empty()) {
      if (hold_look_alikes(read_.table.group)) read_.notes.push_back(note_of("--group"));
      if (hold_look_alikes(read_.table.subject)) read_.notes.push_back(note_of("--subject"));
      if (hold_look_alikes(read_.table.rater)) read_.notes.push_back(note_of("--rater"));
      return std::move(read_);
    }
    error_.text = error_.findings.front().text;
    error_.findings.erase(error_.findings.begin());
    return error_;
  }

 private:
  static std::string note_of(const std::string& option) {
    return "Labels of " + option +
           " differ only in capitals, blanks or look-alike letters: they count as different.";
  }

  std::size_t place_of(const std::string& name, const std::vector<std::string>& header) {
    const auto found = std::find(header.begin(), header.end(), name);
    if (found == header.end()) {
      bad("there is no column " + shown(name) + " among the " + std::to_string(header.size()) + " of the header");
      return 0;
    }
    if (std::find(found + 1, header.end(), name) != header.end()) bad("column " + shown(name) + " occurs twice");
    return static_cast<std::size_t>(found - header.begin());
  }

  double number(const std::string& cell, const std::string& row, const std::string& column) {
    constexpr double kMissing = std::numeric_limits<double>::quiet_NaN();
    if (is_missing(cell)) return kMissing;
    const auto value = parse_number(cell);
    if (value) return *value;
    // As spreadsheets of many countries write it.
    const bool by_comma = std::count(cell.begin(), cell.end(), ',') == 1 &&
                          cell.find_first_not_of("+-0123456789,eE") == std::string::npos;
    bad(row + ", column " + shown(column) +
        (by_comma ? " has a decimal comma: use a point" : " holds no finite number"));
    return kMissing;
  }

  const TableColumns& columns_;
  std::size_t width_ = 0;
  std::vector<std::size_t> value_places_;
  std::optional<std::size_t> group_, subject_, rater_, x_;
  ReadTable read_;
  base::Error error_{"bad_csv", "", {}};
};

}  // namespace

base::Result<ReadTable> table_in_csv(const std::string& text, const TableColumns& columns) {
  std::string_view rest = text;
  if (rest.starts_with("\xef\xbb\xbf")) rest.remove_prefix(3);
  if (!casedb::is_text(rest)) return base::Error{"bad_csv", "it is not UTF-8 text", {}};
  CsvRecords records(rest, separator_of(rest));
  TableReader reader(columns);
  std::vector<std::string> cells;
  const bool has_header = records.next(cells);
  bool readable = !has_header || reader.take_header(cells);
  while (has_header && readable && records.next(cells)) readable = reader.take_row(cells);
  if (records.fault() != nullptr)
    reader.bad((has_header ? "after row " + std::to_string(reader.rows()) + ", " : "in the header, ") +
               records.fault());
  return reader.finish();
}

DataTable stacked(const DataTable& table) {
  DataTable made;
  made.rows = table.rows * table.values.size();
  made.values.push_back({"value", {}});
  for (const assessment::statistics::Column& column : table.values)
    for (std::size_t row = 0; row < table.rows; ++row) {
      made.values.front().values.push_back(column.values[row]);
      made.group.push_back(column.name);
      made.subject.push_back(table.subject.empty() ? std::to_string(row + 1) : table.subject[row]);
    }
  return made;
}

std::vector<std::string> column_names(const std::string& typed) {
  CsvRecords records(typed, ',');
  std::vector<std::string> names, more;
  const bool one_line = records.next(names) && !records.next(more) && records.fault() == nullptr;
  if (!one_line || std::find(names.begin(), names.end(), std::string()) != names.end()) return {};
  return names;
}

}  // namespace seldinger::app
