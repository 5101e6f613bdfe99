#include "app/ratings/known_csv.h"

#include <algorithm>
#include <set>

#include "app/statistics/csv_records.h"

namespace seldinger::app {

base::Result<std::vector<KnownRow>> known_in_csv(const std::string& text) {
  const std::string body = text.starts_with("\xEF\xBB\xBF") ? text.substr(3) : text;
  CsvRecords records(body, ',');
  std::vector<std::string> header, cells;
  if (!records.next(header) || std::find(header.begin(), header.end(), "attempt") == header.end() ||
      std::set<std::string>(header.begin(), header.end()).size() != header.size())
    return base::Error{"bad_csv", "the first line must name the column attempt, and each item once"};
  std::vector<KnownRow> rows;
  while (records.next(cells)) {
    if (cells.size() != header.size())
      return base::Error{"bad_csv",
                         "row " + std::to_string(rows.size() + 1) + " does not have as many cells as the header"};
    KnownRow& row = rows.emplace_back();
    for (std::size_t i = 0; i < cells.size(); ++i) {
      if (header[i] == "attempt")
        row.attempt_id = cells[i];
      else if (!cells[i].empty())
        row.scores.emplace(header[i], cells[i]);
    }
  }
  if (records.fault() != nullptr) return base::Error{"bad_csv", records.fault()};
  return rows;
}

}  // namespace seldinger::app
