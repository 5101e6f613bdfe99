// A copy of a whole library in a folder of its own, made while the library is in use, and back. Beside the two
// databases and the assets lies backup.txt, which names every file with its size and SHA-256. Throws base::Failure
// ("disk", "database").
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "casedb/database/library.h"
#include "sim/base/result.h"

namespace seldinger::casedb {

struct Copied {
  std::size_t files = 0;
  std::uint64_t bytes = 0;
};

// One state of the library, checked before it gets its name: whole under `out`, or nothing is there. It holds names
// of people; only its owner can read it. Refused: `exists` (something has that name), `damaged` (a page, a
// reference, a stored value, a recording: each in `problems`), `asset_missing`, `asset_damaged` (the library itself
// is not whole).
base::Result<Copied> back_up(Library& library, const std::filesystem::path& out,
                             const std::string& program_version);

// Every byte is checked before the library gets its name. Refused: `no_backup`, `damaged` (a file is missing or
// another, a page, a reference, a value or a recording is hurt), `newer_schema`, `exists` (there is something where
// the library is to be), `network_file_system`. Nobody is logged in at what was restored.
base::Result<Copied> restore(const std::filesystem::path& in, const std::filesystem::path& folder);

}  // namespace seldinger::casedb
