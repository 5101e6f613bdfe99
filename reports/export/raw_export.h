// Attempts of a library as a folder of CSV for researchers (docs/export.md): of people who consent, and of
// simulated operators; without names, dates or anything that somebody wrote.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>

#include "casedb/attempts/attempts.h"
#include "casedb/database/credentials.h"
#include "casedb/database/library.h"
#include "sim/base/result.h"

namespace seldinger::reports {

struct RawChoice {
  std::optional<std::string> case_id{};  // attempts at this case only
  std::optional<std::string>
      study_id{};  // of those who consent to it; none: who consent to research with the library
  bool poses = true, forces = true, frames = true, events = true;
  bool sqlite = false, slicer = false, xapi = false, motion_bids = false;  // other formats of the same
  // Of people's attempts numbers as they are stored, and their recordings. False: two significant digits, whole
  // days, and of the recordings the events alone. What a simulated operator did is always exact.
  bool exact = false;
};

struct RawExport {
  std::size_t attempts = 0, synthetic = 0, people = 0, metrics = 0, files = 0;
  std::size_t simulated_people = 0;  // of `people`
};

// `out` appears whole or not at all; attempts that are added meanwhile are not in it. One attempt's recording is in
// memory at a time, beside a few hundred bytes for each attempt of the library. The same key gives the same
// names. Refused: `exists`, `no_case`, `no_study`, and a damaged recording as casedb::load_recording refuses it.
// Throws base::Failure("disk").
base::Result<RawExport> export_raw(casedb::Library& library, const std::filesystem::path& out,
                                   const RawChoice& choice, const casedb::HashKey& key);

}  // namespace seldinger::reports
