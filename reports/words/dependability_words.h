// Φ in words, beside every pass rule that people are judged by.
#pragma once

#include <string>
#include <string_view>

#include "assessment/statistics/answer.h"
#include "casedb/grading/learning.h"

namespace seldinger::reports {

// What stands before the words of `dependability_text`, on pages and in commands.
inline constexpr std::string_view kWhatPassingShows = "What passing one case shows";

// Whether so few people made it up that it is not told.
bool withheld(const assessment::statistics::Answer& dependability, casedb::Learners whose);
// "One case alone: Φ 0.31. …; 9 cases for 0.8." or why there is none; whole sentences.
std::string dependability_text(const assessment::statistics::Answer& dependability, casedb::Learners whose);

// The same in one sentence, where there is room for one.
std::string dependability_line(const assessment::statistics::Answer& dependability, casedb::Learners whose);

}  // namespace seldinger::reports
