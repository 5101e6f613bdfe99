// Numbers by named columns, out of CSV as programs and spreadsheets write it: columns in any order, others beside
// them, quotes, CRLF and a byte-order mark let pass.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "sim/base/result.h"

namespace seldinger::app {

struct CsvRows {
  std::size_t columns = 0;
  std::vector<double> values;       // `columns` a row, finite
  std::vector<std::string> labels;  // one a row; none where no label was asked for

  std::size_t size() const noexcept { return columns == 0 ? 0 : values.size() / columns; }
  std::span<const double> row(std::size_t i) const { return std::span(values).subspan(i * columns, columns); }
};

// The named columns in the order asked, and the text of the column `label`, where given. Rows are counted from 1
// after the header; empty ones are no rows. Refused: `bad_csv` (a column missing or twice, a row of another length,
// no number, no row; at most ten are listed).
base::Result<CsvRows> rows_in_csv(const std::string& text, std::span<const char* const> numbers,
                                  const char* label = nullptr);

}  // namespace seldinger::app
