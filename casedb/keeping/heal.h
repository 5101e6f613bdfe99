// What is hurt in a library is put back from a backup of it, where that is proved to be the very same: a file by
// the SHA-256 that is its name, rows by the digest that was stored with them.
#pragma once

#include <filesystem>
#include <vector>

#include "casedb/database/library.h"
#include "sim/base/result.h"

namespace seldinger::casedb {

// What was put back, in words as those of damaged_values(). Also of a library that does not open because of it.
// What the backup does not have as it was stored stays as it is. Refused: `no_backup` (there is none in `from`, or
// of another schema). Throws Failure("read_only").
base::Result<std::vector<base::Problem>> heal_values(const std::filesystem::path& folder,
                                                     const std::filesystem::path& from);
std::vector<base::Problem> heal_assets(Library& library, const std::filesystem::path& from);

}  // namespace seldinger::casedb
