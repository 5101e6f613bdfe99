// The style of reports that are read from top to bottom, and print.
#pragma once

#include <string>

namespace seldinger::reports {

// A whole style sheet: the pages', and what reports have beside it.
std::string report_style();

}  // namespace seldinger::reports
