#include "casedb/database/migrate.h"

#include <fcntl.h>
#include <unistd.h>

#include <set>
#include <string>

#include "casedb/database/digests.h"
#include "casedb/database/disk.h"
#include "sim/base/check.h"

namespace seldinger::embedded {
std::span<const base::EmbeddedFile> migrations();
std::span<const base::EmbeddedFile> identity_migrations();
}  // namespace seldinger::embedded

namespace seldinger::casedb {
namespace {

namespace fs = std::filesystem;

// Below this size every page is looked at when a library is opened (some milliseconds); damage in larger files is
// met when it is read, or by `seldinger check`.
constexpr std::uintmax_t kQuickCheckBytes = 16U << 20;

void check_step_names(const Schema& schema) {
  for (std::size_t i = 0; i < schema.steps.size(); ++i) {
    const std::string number = std::to_string(i + 1);
    const std::string prefix = std::string(4 - number.size(), '0') + number + "_";
    CHECK(schema.steps[i].name.substr(0, 5) == prefix);
  }
}

// Files as they lie in a folder: the numbered ones, then schema.sql.
Schema schema_of(std::int32_t application_id, std::span<const base::EmbeddedFile> files) {
  return {application_id, files.first(files.size() - 1), base::content_of(files, "schema.sql")};
}

// From `first` to `last`, whole or not at all.
void walk(Sqlite& database, const Schema& schema, int first, int last) {
  Transaction transaction(database);
  if (database.integer("PRAGMA user_version") >= first) return;  // another process was faster
  const auto differences = digest_differences(database);         // damage stays damage
  if (first == 1) database.run("PRAGMA application_id = " + std::to_string(schema.application_id));
  const bool by_sum = first == 1 && last == newest_version(schema) && !schema.sum.empty();
  if (by_sum) database.run(std::string(schema.sum));
  for (int step = first; step <= last && !by_sum; ++step)
    database.run(std::string(schema.steps[static_cast<std::size_t>(step) - 1].content));
  database.run("PRAGMA user_version = " + std::to_string(last));
  if (has_digests(database)) renew_digests(database, differences);
  transaction.commit();
}

// Every table, view, index and trigger, and the tables' columns.
std::set<std::string> shape_of(Sqlite& database) {
  std::set<std::string> shape;
  for (Statement rows = database.prepare(
           "SELECT type || ' ' || name || '.' || coalesce(column_name, '') AS part FROM sqlite_schema LEFT JOIN "
           "(SELECT m.name AS table_name, c.name AS column_name FROM sqlite_schema m, pragma_table_info(m.name) c "
           "WHERE m.type = 'table') ON table_name = name WHERE name NOT LIKE 'sqlite^_%' ESCAPE '^'");
       rows.step();)
    shape.insert(rows.text("part"));
  return shape;
}

// The file is what a walk to its version makes, so that the next step finds what it expects.
base::Result<void> fits(Sqlite& database, const Schema& schema, int version) {
  const std::set<std::string> shape = shape_of(database);
  Sqlite walked(":memory:", Sqlite::Mode::create);
  int fitting = 0;
  for (int step = 1; step <= newest_version(schema) && fitting != version; ++step) {
    build(walked, schema, step);
    if (shape_of(walked) == shape) fitting = step;
  }
  if (fitting == version) return {};
  const std::string says = "the library's database says that it has schema " + std::to_string(version);
  const std::string next(schema.steps[static_cast<std::size_t>(version)].name);
  if (fitting > 0)
    return base::Error{
        "schema_mismatch",
        says + " but has schema " + std::to_string(fitting) + ", so that migration " + next +
            " cannot be walked; nothing was changed: restore a backup, or set PRAGMA user_version to " +
            std::to_string(fitting)};
  return base::Error{"schema_mismatch", says + " but does not hold its tables, so that migration " + next +
                                            " cannot be walked; nothing was changed: restore a backup"};
}

}  // namespace

Schema library_schema() {
  return schema_of(0x534c4447, embedded::migrations());  // "SLDG"
}

Schema identities_schema() {
  return schema_of(0x534c4449, embedded::identity_migrations());  // "SLDI"
}

int newest_version(const Schema& schema) {
  return static_cast<int>(schema.steps.size());
}

base::Result<int> schema_version(Sqlite& database, const Schema& schema) {
  check_step_names(schema);
  const base::Error damaged{"damaged", "the library's database is damaged; restore a backup"};
  try {
    const auto application = database.integer("PRAGMA application_id");
    const auto version = database.integer("PRAGMA user_version");
    const auto objects = database.integer("SELECT count(*) FROM sqlite_schema");
    if (application == 0 && version == 0 && objects == 0) return 0;
    if (application != schema.application_id)
      return base::Error{"not_a_library", "the database there was made by another program"};
    if (version > newest_version(schema))
      return base::Error{"newer_schema", "the library was written by a newer version of this program (schema " +
                                             std::to_string(version) + ", known up to " +
                                             std::to_string(newest_version(schema)) + ")"};
    if (version < 1 || objects == 0) return damaged;
    std::error_code ignored;
    if (fs::file_size(database.file(), ignored) <= kQuickCheckBytes &&
        database.text("PRAGMA quick_check(1)") != "ok")
      return damaged;
    return static_cast<int>(version);
  } catch (const DatabaseFailure& failure) {
    if (failure.kind() == DatabaseFailure::Kind::not_a_database)
      return base::Error{"not_a_library", "the file there is no database"};
    if (failure.kind() == DatabaseFailure::Kind::damaged) return damaged;
    throw;
  }
}

base::Result<void> migrate(Sqlite& database, const Schema& schema) {
  const auto version = schema_version(database, schema);
  if (!version) return version.error();
  const bool older = *version > 0 && *version < newest_version(schema);
  if (older)
    if (const auto fit = fits(database, schema, *version); !fit) return fit.error();
  if (database.text("PRAGMA journal_mode = WAL") != "wal")
    throw DatabaseFailure(DatabaseFailure::Kind::other, "the database cannot be set to write-ahead logging");
  if (older) {
    const std::string name = database.file().string() + ".v" + std::to_string(*version) + "-backup";
    std::string free_name = name;
    for (int i = 2; fs::exists(free_name); ++i) free_name = name + "-" + std::to_string(i);
    copy_database(database, free_name);
  }
  build(database, schema, newest_version(schema));
  return {};
}

void build(Sqlite& database, const Schema& schema, int version) {
  const auto first = static_cast<int>(database.integer("PRAGMA user_version")) + 1;
  // Of nothing, and of rows in memory, which nobody else walks, there is one digest to take.
  const bool at_once = first == 1 || database.file() == ":memory:";
  if (at_once && first <= version) return walk(database, schema, first, version);
  for (int step = first; step <= version; ++step) walk(database, schema, step, step);
}

void copy_database(Sqlite& database, const fs::path& file) {
  const fs::path temporary = file.string() + ".tmp-" + std::to_string(::getpid());
  ::unlink(temporary.c_str());  // of a process of that number that was killed
  const int descriptor = ::open(temporary.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0600);
  if (descriptor < 0) throw base::Failure("disk", "the copy of the database cannot be written");
  ::close(descriptor);
  try {
    {
      Sqlite copy(temporary);
      copy.run("PRAGMA synchronous = OFF");  // it is synced as a whole
      database.copy_to(copy);
      // The copy also says of itself that it has a write-ahead log; it is to be one file.
      if (copy.text("PRAGMA journal_mode = DELETE") != "delete")
        throw DatabaseFailure(DatabaseFailure::Kind::other, "the copy of the database cannot be finished");
    }
    sync_file(temporary);
    // link, unlike rename, does not replace what is there.
    if (::link(temporary.c_str(), file.c_str()) != 0)
      throw base::Failure("disk", "the copy of the database cannot be named");
    ::unlink(temporary.c_str());
    sync_folder(file.parent_path());
  } catch (...) {
    ::unlink(temporary.c_str());
    throw;
  }
}

}  // namespace seldinger::casedb
