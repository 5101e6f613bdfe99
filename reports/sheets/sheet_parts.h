// Parts of a replay's sheet: pictures at moments, and the needle's way in the body.
#pragma once

#include <functional>

#include "reports/markup/html.h"
#include "reports/sheets/replay_sheet.h"

namespace seldinger::reports {

// Where a page finds a picture: an address, or the picture itself.
using Placed = std::function<std::string(const std::vector<std::byte>& png)>;
std::string in_the_page(const std::vector<std::byte>& png);

Html sheet_strip(const ReplaySheet& sheet, const Placed& placed = in_the_page);
// The film, worked by reports/pages/film.js, which shows it; nothing without pictures.
Html sheet_film(const ReplaySheet& sheet);
Html sheet_planes(const ReplaySheet& sheet,
                  const Placed& placed = in_the_page);  // nothing where there are no planes

}  // namespace seldinger::reports
