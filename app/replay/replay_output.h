// A replay to look at: frames in a folder, a film, a sheet, or what raters see.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "casedb/attempts/attempts.h"
#include "reports/pages/attempt_page.h"
#include "session/attempt/replayed_attempt.h"

namespace seldinger::app {

constexpr double kDefaultReplayHz = 10.0, kMostReplayHz = 60.0;

struct ReplayWritten {
  session::Replay replay;  // where it differs nothing was written
  std::size_t pictures = 0;
  double seconds = 0.0;  // that it took
};

// By what `out` ends in: .html a sheet, .mp4 a film, else a new folder of frame_000001.png …, `rate_hz` a second of
// the attempt. Whole or not at all. What another step version recorded is drawn as this one steps it, and says so.
// Refused: `exists` (a folder), and as build_case_of and make_signals. Throws base::Failure ("disk", "ffmpeg").
base::Result<ReplayWritten> write_replay(casedb::Library& library, const casedb::AttemptRow& attempt,
                                         const cases::Recording& recording, const std::filesystem::path& out,
                                         double rate_hz);

// The pictures of an attempt at its telling moments (assessment/moments.h), as reports/sheets/moments_sheet.h.
// Refused: `no_attempt`, `replay_differs`, and as build_case_of and make_signals. Takes seconds.
base::Result<reports::DrawnPictures> telling_pictures(casedb::Library& library, const std::string& attempt_id);

// The attempt as raters see it: reports/sheets/blinded_replay.h. Refused: `not_to_be_rated` (another step version
// recorded it, or its replay differs), and as build_case_of and make_signals.
base::Result<std::string> replay_to_rate(casedb::Library& library, const casedb::AttemptRow& attempt,
                                         const cases::Recording& recording);

}  // namespace seldinger::app
