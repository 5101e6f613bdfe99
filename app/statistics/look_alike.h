// Labels that a reader takes for the same and a program does not: "Novice", "novice " and "nоvice" with a Cyrillic
// о.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace seldinger::app {

// The label as an eye takes it: without capitals and blanks, and with Greek and Cyrillic letters that look Latin as
// those (Unicode's UTS #39 has the whole table; these are the ones on a keyboard).
std::string as_seen(std::string_view label);

// Whether two labels, of those that are not missing, differ and look the same.
bool hold_look_alikes(const std::vector<std::string>& labels);

}  // namespace seldinger::app
