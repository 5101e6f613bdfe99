// What was on the screen at the telling moments of an attempt, and the needle's way in the body.
#pragma once

#include "reports/pages/attempt_page.h"
#include "reports/sheets/replay_sheet.h"

namespace seldinger::reports {

// Part of a page that has the dashboard's style sheet, and the pictures that it names. Of `sheet.attempt` only
// picture and needle are read.
DrawnPictures moments_sheet(const ReplaySheet& sheet);

}  // namespace seldinger::reports
