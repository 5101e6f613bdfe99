// A key that makes names and UIDs the same in several runs: 64 hexadecimal digits in a file.
#pragma once

#include <string>

#include "casedb/database/credentials.h"
#include "sim/base/result.h"

namespace seldinger::app {

// A random one for an empty path; made, readable by its owner only, when there is no such file. Refused: `bad_key`,
// and as read_text. Throws base::Failure("disk").
base::Result<casedb::HashKey> key_from_file(const std::string& path);
// None is made: `bad_key`, and as read_text.
base::Result<casedb::HashKey> existing_key(const std::string& path);

}  // namespace seldinger::app
