// A replay as raters see it: pictures at even moments, the needle's way in the body, and its depth over time.
// Nothing of whose it is, when it was made, which attempt or case it is, or of what the recording knows and a rater
// is asked to judge: what the picture showed, steps, metrics.
#pragma once

#include <string>

#include "reports/sheets/replay_sheet.h"

namespace seldinger::reports {

// Part of a page that has the dashboard's style sheet. Of `sheet.attempt` only picture and needle are read.
std::string blinded_replay(ReplaySheet sheet);

}  // namespace seldinger::reports
