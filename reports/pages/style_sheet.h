// The one style sheet of all pages: served by the dashboard, and put into pages that are files of their own. And
// the scripts, each of the pages that need it, and the icon.
#pragma once

#include <string_view>

namespace seldinger::reports {

std::string_view style_sheet();
std::string_view keep_typed_script();
std::string_view replay_script();
std::string_view film_script();
std::string_view tables_script();
std::string_view jobs_script();  // that sends files and tells how far a job is
std::string_view icon();         // SVG

}  // namespace seldinger::reports
