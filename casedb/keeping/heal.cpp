#include "casedb/keeping/heal.h"

#include <algorithm>
#include <bit>
#include <map>
#include <optional>
#include <string>

#include "casedb/database/credentials.h"
#include "casedb/database/digests.h"
#include "casedb/database/disk.h"
#include "casedb/database/sqlite.h"
#include "casedb/database/tables.h"
#include "sim/base/hash.h"

namespace seldinger::casedb {
namespace {

namespace fs = std::filesystem;

bool is_sound_piece(const Statement& row) {
  return std::bit_cast<std::uint64_t>(row.integer("checksum")) == base::hash_bytes(row.bytes("data"));
}

// Recordings whose pieces are not what their checksums say; their digests do not tell.
void add_damaged_recordings(Sqlite& database, std::map<DigestOf, std::uint64_t>& differences) {
  for (const std::string table : {"recording_chunk", "open_chunk"})
    for (Statement rows = database.prepare("SELECT attempt_id, checksum, data FROM " + table); rows.step();)
      if (!is_sound_piece(rows)) differences.try_emplace({table, rows.text("attempt_id")}, 0);
}

// The rows of one table and id in one database.
class Rows {
 public:
  Rows(Sqlite& database, const DigestOf& whose) : database_(database), whose_(whose) {}
  // Of the rows that are there; none: a piece of a recording is not what its checksum says.
  std::optional<std::uint64_t> digest() {
    std::uint64_t sum = 0;
    bool sound = true;
    count = 0;
    for (Statement rows = select(); rows.step(); ++count) {
      sound = sound && (!whose_.first.ends_with("_chunk") || is_sound_piece(rows));
      sum ^= rows.digest(whose_.first).second;
    }
    return sound ? std::optional(sum) : std::nullopt;
  }
  std::uint64_t stored_digest() {
    Statement row = database_.prepare("SELECT sum FROM digest WHERE of_table = :of_table AND of_id = :of_id");
    row.bind("of_table", whose_.first).bind("of_id", whose_.second);
    return row.step() ? static_cast<std::uint64_t>(row.integer("sum")) : 0;
  }
  void become(Rows& others) {
    const std::vector<std::string> columns = columns_of(database_, whose_.first);
    std::string names, places;
    for (const std::string& column : columns) {
      names += (names.empty() ? "" : ", ") + column;
      places += (places.empty() ? ":" : ", :") + column;
    }
    database_.prepare("DELETE FROM " + whose_.first + where()).bind("id", whose_.second).run();
    Statement insert =
        database_.prepare("INSERT INTO " + whose_.first + " (" + names + ") VALUES (" + places + ")");
    for (Statement row = others.select(); row.step(); insert.run())
      for (const std::string& column : columns) insert.bind_value(column, row);
  }

  std::size_t count = 0;  // of the rows that digest() went through

 private:
  std::string where() { return " WHERE " + rows_of_digest(database_, whose_.first); }
  Statement select() {
    Statement rows = database_.prepare("SELECT * FROM " + whose_.first + where());
    rows.bind("id", whose_.second);
    return rows;
  }
  Sqlite& database_;
  const DigestOf& whose_;
};

// Whether what belongs to `whose` is again as it was stored.
bool healed(Sqlite& ours, Sqlite& theirs, const DigestOf& whose) {
  Rows here(ours, whose), there(theirs, whose);
  const std::optional<std::uint64_t> backed_up = there.digest(), now = here.digest();
  if (!backed_up || *backed_up != there.stored_digest()) return false;  // the backup is hurt itself
  const std::uint64_t stored = here.stored_digest();
  // More rows than the backup has may be of after it, when it is the digest that went back: none is taken away.
  if (*backed_up == stored && here.count <= there.count) {
    here.become(there);
    return true;
  }
  // One bit of the digest itself turned over. That rows are as in an older copy proves nothing else: a loss or a
  // lost write looks the same, but differs in about half of the bits.
  if (now == backed_up && std::has_single_bit(*now ^ stored)) {
    change_digest(ours, whose, *now ^ stored);
    return true;
  }
  return false;
}

base::Result<std::vector<base::Problem>> heal_one(const fs::path& file, const fs::path& backup, bool recordings) {
  std::vector<base::Problem> done;
  Sqlite ours(file), theirs(backup, Sqlite::Mode::immutable);
  if (!has_digests(ours)) return done;  // older; it is migrated first
  if (!has_digests(theirs) || ours.integer("PRAGMA user_version") != theirs.integer("PRAGMA user_version"))
    return base::Error{"no_backup", "the backup has another schema than the library"};
  const Sqlite::Unguarded as_it_was(ours);  // rows that do not change come back
  Transaction transaction(ours);
  auto differences = digest_differences(ours);
  if (recordings) add_damaged_recordings(ours, differences);
  const std::vector<std::string> tables = tables_of(ours);
  for (const auto& [whose, difference] : differences) {
    if (std::ranges::find(tables, whose.first) == tables.end()) continue;  // the schema itself
    if (healed(ours, theirs, whose)) done.push_back({"value_damaged", in_words(whose) + " is as it was stored"});
  }
  ours.forget_changes();  // the digests are those of the rows as they were
  transaction.commit();
  return done;
}

}  // namespace

base::Result<std::vector<base::Problem>> heal_values(const fs::path& folder, const fs::path& from) {
  std::vector<base::Problem> done;
  if (what_is(folder / kDatabaseFile) != Place::file || what_is(folder / kIdentitiesFile) != Place::file)
    return done;  // opening it tells
  if (!can_write(folder) || !can_write(folder / kDatabaseFile))
    throw base::Failure("read_only", "the library can only be read: its disk or its folder is write-protected");
  for (const char* file : {kDatabaseFile, kIdentitiesFile}) {
    if (what_is(from / file) != Place::file) return base::Error{"no_backup", "there is no backup in that folder"};
    try {
      auto one = heal_one(folder / file, from / file, file == kDatabaseFile);
      if (!one) return one.error();
      done.insert(done.end(), one->begin(), one->end());
    } catch (const DatabaseFailure& failure) {
      // Pages that cannot be read: the check that follows tells, and nothing was changed.
      if (failure.kind() != DatabaseFailure::Kind::damaged &&
          failure.kind() != DatabaseFailure::Kind::not_a_database)
        throw;
    }
  }
  return done;
}

std::vector<base::Problem> heal_assets(Library& library, const fs::path& from) {
  std::vector<base::Problem> done;
  for (const std::string& name : assets_named(library.database())) {
    if (!is_asset_name(name) || library.asset_state(name) == Library::AssetState::sound) continue;
    if (what_is(from / kAssetsFolder / name) != Place::file) continue;
    const std::vector<std::byte> bytes = read_whole(from / kAssetsFolder / name);
    if (sha256_hex(bytes) != name) continue;
    library.store_asset(bytes);
    if (library.asset_state(name) == Library::AssetState::sound)
      done.push_back({"asset_damaged", "the file " + name + " of assets/ is as it was stored"});
  }
  return done;
}

}  // namespace seldinger::casedb
