// The thesis' three workshops (Vidal, section 6.3, tables 6.1 to 6.3, figures 6.14 to 6.18) as one page: what was
// printed, how many can have answered, what they can have said, and where text, tables and captions differ.
#pragma once

#include <string>

namespace seldinger::reports {

std::string workshops_page();

}  // namespace seldinger::reports
