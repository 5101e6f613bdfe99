// The calibration set as a CSV file: a column `attempt`, and one for each item of the form whose score is agreed
// on.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "sim/base/result.h"

namespace seldinger::app {

struct KnownRow {
  std::string attempt_id;
  std::map<std::string, std::string> scores;  // by column, as typed; empty cells are none
};
// Refused: `bad_csv`. Whether a column is an item is asked when the round is opened.
base::Result<std::vector<KnownRow>> known_in_csv(const std::string& text);

}  // namespace seldinger::app
