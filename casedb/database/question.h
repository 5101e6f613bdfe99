// The SQL of the store lies in sql/<name>.sql of its shelf and is built in; this finds it.
#pragma once

#include <string_view>

#include "casedb/database/sqlite.h"

namespace seldinger::casedb {

// CHECKs that there is such a file.
Statement question(Sqlite& database, std::string_view name);

}  // namespace seldinger::casedb
