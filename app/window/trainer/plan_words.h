// A way that was planned, and what became of it, in words.
#pragma once

#include <string>
#include <vector>

#include "assessment/plan_comparison.h"
#include "session/case/planned_way.h"

namespace seldinger::app {

// "62 mm from the skin, 12° off perpendicular, 5° towards the head".
std::string way_words(const session::PlannedWay& way);
// What speaks against it, each in a line: "through bone, 3 mm of it, 21 mm below the skin".
std::vector<std::string> warnings_of(const session::PlannedWay& way);

// What was done against what was planned, each in a line. `done` null: the needle was never in.
std::vector<std::string> compared_words(const assessment::PlannedPath& planned,
                                        const assessment::PlannedPath* done);

}  // namespace seldinger::app
