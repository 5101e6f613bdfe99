// One line of CSV after RFC 4180, as R, pandas and spreadsheets read it: UTF-8, '.' decimals, LF, nothing for a
// missing value.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace seldinger::reports {

// How numbers are written: each as its own bits, or to two significant digits (docs/export.md says of whom).
enum class Precision { exact, coarse };

double as_told(double value, Precision precision) noexcept;  // the number that is written

class CsvLine {
 public:
  explicit CsvLine(Precision precision = Precision::exact) : precision_(precision) {}
  // Quoted where it must be. A spreadsheet takes what begins with = + - @ tab, CR or NUL for a formula: such text
  // gets an apostrophe before it (OWASP ASVS 5.0, 1.2.10). Numbers stay bare.
  CsvLine& text(std::string_view text);
  // The shortest digits that read back as the same bits, of what precision leaves; nothing when not finite.
  CsvLine& number(double value);
  CsvLine& number(const std::optional<double>& value) { return value ? number(*value) : nothing(); }
  CsvLine& whole(std::int64_t value);
  CsvLine& whole(std::uint64_t value);
  CsvLine& flag(bool value) { return whole(std::int64_t{value ? 1 : 0}); }
  CsvLine& nothing();

  // The line with its end; the next one begins.
  std::string take();

 private:
  CsvLine& cell(std::string_view text);
  Precision precision_;
  std::string line_;
  bool first_ = true;
};

// Reads such lines again: the cells of the first of `rest`, which it leaves. False where nothing is left.
bool next_csv_line(std::string_view& rest, std::vector<std::string>& cells);

}  // namespace seldinger::reports
