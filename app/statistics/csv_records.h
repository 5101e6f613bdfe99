// CSV after RFC 4180, record by record: quotes hold separators, line ends and doubled quotes. Lines may end in LF,
// CRLF or CR, and blanks beside a cell are not of it.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace seldinger::app {

class CsvRecords {
 public:
  CsvRecords(std::string_view text, char separator) : rest_(text), separator_(separator) {}

  // The cells of the next record; lines without a letter are none. False at the end, and at a fault.
  bool next(std::vector<std::string>& cells);
  // What is not CSV, in words; nullptr: nothing so far. Nothing is read after it.
  const char* fault() const noexcept { return fault_; }

 private:
  // True: the record goes on after the cell. `quoted` says whether the cell was in quotes.
  bool take_cell(std::string& cell, bool& quoted);
  void take_quoted(std::string& cell);

  std::string_view rest_;
  char separator_;
  const char* fault_ = nullptr;
};

}  // namespace seldinger::app
