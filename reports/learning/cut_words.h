// Cuts in words.
#pragma once

#include <string>

#include "casedb/grading/cuts.h"

namespace seldinger::reports {

std::string cut_method_text(const std::string& method);  // "Contrasting groups"
std::string cut_scale_text(
    const casedb::Cut& cut);  // "Distance to target centre, mm"; "Share of items that are right"
// "Distance to target centre at most 4.2 mm (3.5 to 5.1), n = 24, contrasting groups"
std::string cut_text(const casedb::Cut& cut);
// "Proposed by P-3f2 on …; frozen by P-9a1 on …"
std::string cut_standing_text(const casedb::Cut& cut);

}  // namespace seldinger::reports
