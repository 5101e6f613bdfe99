// An attempt's course for the replay in a browser.
#pragma once

#include <string>

#include "casedb/attempts/attempts.h"

namespace seldinger::web {

// Poses in LPS, told to 0.1 mm and thinned to at most 1,200, the first, the last and the moment of firing among
// them; the target, the needle's length, the picture's size, what each picture showed of the tip. Poses that are
// not finite are left out.
std::string replay_json(const casedb::AttemptRow& row, const cases::Recording& recording);

}  // namespace seldinger::web
