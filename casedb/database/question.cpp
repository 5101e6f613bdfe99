#include "casedb/database/question.h"

#include <algorithm>

#include "sim/base/check.h"
#include "sim/base/embedded.h"

namespace seldinger::embedded {
std::span<const base::EmbeddedFile> questions();
}

namespace seldinger::casedb {

Statement question(Sqlite& database, std::string_view name) {
  const auto files = embedded::questions();
  const auto file = std::find_if(files.begin(), files.end(), [&](const base::EmbeddedFile& candidate) {
    return candidate.name.size() == name.size() + 4 && candidate.name.starts_with(name);  // ".sql"
  });
  CHECK(file != files.end());
  return database.prepare(file->content);
}

}  // namespace seldinger::casedb
