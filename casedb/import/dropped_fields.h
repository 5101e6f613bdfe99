// What of a file's header a case leaves out.
#pragma once

#include <filesystem>
#include <vector>

#include "casedb/cases/privacy.h"
#include "casedb/import/files/read_file.h"

namespace seldinger::casedb {

// Fields of the header, beside shape and place, that hold something; they do not enter a case.
std::vector<Dropped> dropped_fields(const std::filesystem::path& file, FileFormat format);

}  // namespace seldinger::casedb
