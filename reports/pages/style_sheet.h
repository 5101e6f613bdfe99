// The one style sheet of all pages: served by the dashboard, and put into pages that are files of their own.
#pragma once

#include <string_view>

namespace seldinger::reports {

std::string_view style_sheet();

}  // namespace seldinger::reports
