// Attempts at a curriculum's items over time: one row an item, one mark an attempt, passed or not.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "assessment/grading/standing.h"
#include "reports/markup/html.h"

namespace seldinger::reports {

struct PassRow {
  std::string label;
  const std::vector<assessment::GradedAttempt>* attempts = nullptr;  // oldest first
};

// Time runs evenly by attempt, not by day: attempts of one hour are not drawn on top of each other. Days stand
// under the first attempt of each. A mark is a link to its attempt, and tells itself in words. Empty without
// attempts.
Html pass_chart(const std::vector<PassRow>& rows);

}  // namespace seldinger::reports
