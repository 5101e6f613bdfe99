#include "reports/export/csv_line.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <utility>

namespace seldinger::reports {
namespace {

constexpr std::string_view kFormulaStarts("=+-@\t\r\0", 7);

// To two significant digits.
double coarse(double value) noexcept {
  char digits[32];
  const auto end = std::to_chars(std::begin(digits), std::end(digits), value, std::chars_format::scientific, 1).ptr;
  std::from_chars(digits, end, value);
  return value;
}

}  // namespace

double as_told(double value, Precision precision) noexcept {
  return precision == Precision::coarse && std::isfinite(value) ? coarse(value) : value;
}

CsvLine& CsvLine::cell(std::string_view text) {
  if (!first_) line_ += ',';
  first_ = false;
  line_ += text;
  return *this;
}

CsvLine& CsvLine::text(std::string_view text) {
  const bool formula = !text.empty() && kFormulaStarts.find(text.front()) != std::string_view::npos;
  const bool quoted = text.find_first_of(",\"\r\n") != std::string_view::npos;
  std::string all = quoted ? "\"" : "";
  if (formula) all += '\'';
  for (const char c : text) {
    if (c == '"') all += '"';
    all += c;
  }
  if (quoted) all += '"';
  return cell(all);
}

CsvLine& CsvLine::number(double value) {
  if (!std::isfinite(value)) return nothing();
  value = as_told(value, precision_);
  char digits[32];
  const auto end = std::to_chars(std::begin(digits), std::end(digits), value).ptr;
  return cell({digits, static_cast<std::size_t>(end - digits)});
}

CsvLine& CsvLine::whole(std::int64_t value) {
  return cell(std::to_string(value));
}

CsvLine& CsvLine::whole(std::uint64_t value) {
  return cell(std::to_string(value));
}

CsvLine& CsvLine::nothing() {
  return cell({});
}

std::string CsvLine::take() {
  first_ = true;
  line_ += '\n';
  return std::exchange(line_, {});
}

bool next_csv_line(std::string_view& rest, std::vector<std::string>& cells) {
  cells.clear();
  if (rest.empty()) return false;
  cells.emplace_back();
  bool quoted = false;
  std::size_t i = 0;
  for (; i < rest.size() && (quoted || rest[i] != '\n'); ++i) {
    if (rest[i] == '"') {
      // A quote within quotes is written twice.
      if (quoted && i + 1 < rest.size() && rest[i + 1] == '"')
        cells.back() += rest[i++];
      else
        quoted = !quoted;
    } else if (rest[i] == ',' && !quoted) {
      cells.emplace_back();
    } else {
      cells.back() += rest[i];
    }
  }
  rest.remove_prefix(std::min(i + 1, rest.size()));
  return true;
}

}  // namespace seldinger::reports
