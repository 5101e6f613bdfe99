// The board of a workshop's day, for a projector: who, by the number that they were given, is at which station of
// theirs, and what they have done. Neither names nor pseudonyms, groups or outcomes.
#pragma once

#include <string>
#include <vector>

#include "casedb/workshops/workshops.h"

namespace seldinger::reports {

// How often a browser asks for it again.
inline constexpr int kBoardEveryS = 10;

std::string board_page(const casedb::Workshop& workshop, const std::vector<casedb::Participant>& participants);
// Asks for the code of a workshop; `problem`: of the one that was typed.
std::string board_start_page(const std::string& problem);

}  // namespace seldinger::reports
