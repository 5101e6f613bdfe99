// A pose file of `seldinger score` (docs/commands.md): one row per instant, the first row with fire = 1 is the
// endpoint.
#pragma once

#include <string>

#include "sim/base/result.h"
#include "sim/case/record/recording.h"

namespace seldinger::app {

// Poses and endpoint only: what the pictures showed is added by the caller. Rows are counted from 1 after the
// header. Refused: `bad_csv` (a column missing, a row of another length, no number; at most ten are listed),
// `bad_poses`.
base::Result<cases::Recording> recording_from_csv(const std::string& text);

}  // namespace seldinger::app
