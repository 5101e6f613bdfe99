// One case's rows, of every table that travels, as bytes and back. Columns go by name, so that rows of an older
// schema walk the migrations before they are stored.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "casedb/database/sqlite.h"
#include "sim/base/result.h"

namespace seldinger::casedb {

constexpr std::size_t kMostRowBytes = std::size_t{8} << 20;  // of one case; its voxels and meshes are files

// Nobody and nothing that stays is named in them (casedb/tables.h).
std::vector<std::byte> bytes_from_rows(Sqlite& library, const std::string& case_id);

// Reads rows that were written at one version of the schema, in one thread. Of a case's title it takes what is one
// (fitted_title).
class RowsReader {
 public:
  explicit RowsReader(int version);
  // A database in memory that holds these rows and no others, brought to the newest schema. Every constraint of the
  // schema holds in it. Refused: `damaged`, `bundle_values` (rows_are_sound).
  base::Result<std::unique_ptr<Sqlite>> read(std::span<const std::byte> bytes, const std::string& case_id);

 private:
  Sqlite& empty_;  // of this thread; it is copied, not walked, for each case
};

// SHA-256 of what cannot change of a case without its being another: all its rows, but for the columns that may.
std::string mark_of_rows(Sqlite& library, const std::string& case_id);

enum class Presence { absent, same, different };
// Whether the library has that case, and all that is said of it. What a person may change of a case (title, state)
// and what was added to it in the library make no difference.
Presence presence(Sqlite& rows, Sqlite& library, const std::string& case_id);

// In a transaction of the library's. What was published arrives in review, and what the sender says of its own
// review, of faces and of burned-in text is kept beside the case, as the sender's, with the key that signed it, if
// any.
void insert_rows(Sqlite& rows, Sqlite& library, const std::string& case_id,
                 const std::optional<std::string>& signing_key = {});

}  // namespace seldinger::casedb
