// Brings a database file to the schema this program knows: numbered steps from migrations/, never edited after
// release, each one transaction with its version number. A new file takes the sum of them, migrations/schema.sql.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "casedb/database/sqlite.h"
#include "sim/base/embedded.h"
#include "sim/base/result.h"

namespace seldinger::casedb {

struct Schema {
  std::int32_t application_id = 0;              // marks the file as ours (SQLite's header, offset 68)
  std::span<const base::EmbeddedFile> steps{};  // "0001_….sql", "0002_….sql", …
  std::string_view sum{};  // what all of them make of nothing, twenty times as fast; empty: they are walked
};

Schema library_schema();
Schema identities_schema();

// The version of a file that is ours; 0 for one in which nothing was ever stored. Reads only. Refused:
// `not_a_library` (no SQLite file, or another program's), `damaged`, `newer_schema`.
base::Result<int> schema_version(Sqlite& database, const Schema& schema);

// Walks the missing steps. A file with content is first copied beside itself, under its name with
// `.v<version>-backup`. Refused as schema_version, and `schema_mismatch`: the file does not hold what its version
// says (somebody set the number back, or changed a table). Two processes may do this at once: each step is walked
// by one of them.
base::Result<void> migrate(Sqlite& database, const Schema& schema);

// Walks the missing steps up to a version and no further, or takes their sum; copies nothing.
void build(Sqlite& database, const Schema& schema, int version);
int newest_version(const Schema& schema);

// A consistent copy of the database, whole and on disk when this returns. Never overwrites.
void copy_database(Sqlite& database, const std::filesystem::path& file);

}  // namespace seldinger::casedb
