// A sheet of pictures: one self-contained HTML page, rows of scenes, columns of what is changed about them.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace seldinger::reports {

struct SheetRow {
  std::string name;
  std::vector<std::vector<std::byte>> png;  // one a column
  std::vector<std::string> captions;        // one a column; may be empty texts
};

// As many pictures and captions in each row as there are columns (CHECK).
std::string picture_sheet(const std::string& title, const std::vector<std::string>& columns,
                          const std::vector<SheetRow>& rows);

}  // namespace seldinger::reports
