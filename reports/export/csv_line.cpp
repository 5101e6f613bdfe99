#include "reports/export/csv_line.h"

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
  if (precision_ == Precision::coarse) value = coarse(value);
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

}  // namespace seldinger::reports
