// Parts of a replay's sheet: pictures at moments, and the needle's way in the body.
#pragma once

#include "reports/markup/html.h"
#include "reports/sheets/replay_sheet.h"

namespace seldinger::reports {

Html sheet_strip(const ReplaySheet& sheet);
// The film, worked by reports/pages/film.js, which shows it; nothing without pictures.
Html sheet_film(const ReplaySheet& sheet);
Html sheet_planes(const ReplaySheet& sheet);  // nothing where there are no planes

}  // namespace seldinger::reports
