#include "casedb/database/question.h"

#include "sim/base/embedded.h"

namespace seldinger::embedded {
std::span<const base::EmbeddedFile> questions();
}

namespace seldinger::casedb {

Statement question(Sqlite& database, std::string_view name) {
  return database.prepare(base::content_of(embedded::questions(), std::string(name) + ".sql"));
}

}  // namespace seldinger::casedb
