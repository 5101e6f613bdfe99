#include "app/statistics/csv_records.h"

namespace seldinger::app {

void CsvRecords::take_quoted(std::string& cell) {
  rest_.remove_prefix(1);
  for (;;) {
    const std::size_t quote = rest_.find('"');
    if (quote == std::string_view::npos) {
      fault_ = "a quotation mark is not closed";
      return;
    }
    cell += rest_.substr(0, quote);
    rest_.remove_prefix(quote + 1);
    if (!rest_.starts_with('"')) return;
    cell += '"';
    rest_.remove_prefix(1);
  }
}

bool CsvRecords::take_cell(std::string& cell, bool& quoted) {
  const auto skip_blanks = [this] {
    while (!rest_.empty() && (rest_.front() == ' ' || (rest_.front() == '\t' && separator_ != '\t')))
      rest_.remove_prefix(1);
  };
  cell.clear();
  skip_blanks();
  quoted = rest_.starts_with('"');
  if (quoted) {
    take_quoted(cell);
    skip_blanks();
  } else {
    const std::string_view letters = rest_.substr(0, rest_.find_first_of(std::string{separator_, '\r', '\n'}));
    rest_.remove_prefix(letters.size());
    cell = letters.substr(0, letters.find_last_not_of(" \t") + 1);
    if (cell.find('"') != std::string::npos)
      fault_ = "a quotation mark is inside a cell that does not begin with one";
  }
  if (fault_ != nullptr || rest_.empty()) return false;
  const char after = rest_.front();
  if (quoted && after != separator_ && after != '\r' && after != '\n') {
    fault_ = "there is something between a closing quotation mark and the end of its cell";
    return false;
  }
  rest_.remove_prefix(1);
  if (after == '\r' && rest_.starts_with('\n')) rest_.remove_prefix(1);
  return after == separator_;
}

bool CsvRecords::next(std::vector<std::string>& cells) {
  while (fault_ == nullptr && !rest_.empty()) {
    std::size_t count = 0;
    bool goes_on = true, quoted = false;
    while (goes_on) {
      if (cells.size() == count) cells.emplace_back();
      goes_on = take_cell(cells[count++], quoted);
    }
    cells.resize(count);
    if (fault_ == nullptr && (count > 1 || quoted || !cells.front().empty())) return true;
  }
  return false;
}

}  // namespace seldinger::app
