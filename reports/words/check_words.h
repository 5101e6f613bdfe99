// How the checks of a case are called, for people.
#pragma once

#include <string>
#include <string_view>

#include "casedb/cases/case_checks.h"

namespace seldinger::reports {

// "Free way" of lesion_reachable; a name it does not know gives its own words.
std::string check_label(std::string_view name);
// What was found, without the code that a program reads before it.
std::string check_words(const casedb::Check& check);

}  // namespace seldinger::reports
