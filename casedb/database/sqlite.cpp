#include "casedb/database/sqlite.h"

// Debian's SQLite has the hook; its header tells of it only so.
#define SQLITE_ENABLE_PREUPDATE_HOOK 1
#include <sqlite3.h>

#include <limits>
#include <optional>
#include <set>
#include <span>

#include "casedb/database/digests.h"
#include "sim/base/check.h"
#include "sim/base/hash.h"

namespace seldinger::casedb {
namespace {

DatabaseFailure failure(int code, const std::string& message) {
  using Kind = DatabaseFailure::Kind;
  switch (code & 0xff) {  // the primary code of an extended one
    case SQLITE_FULL:
      return {Kind::disk, "the disk is full"};
    case SQLITE_IOERR:
      return {Kind::disk, "the disk is full or fails: " + message};
    case SQLITE_CANTOPEN:
    case SQLITE_READONLY:
    case SQLITE_PERM:
      return {Kind::disk, "the database's file or folder cannot be written: " + message};
    case SQLITE_BUSY:
    case SQLITE_LOCKED:
      return {Kind::busy, "another program keeps the database locked"};
    case SQLITE_CONSTRAINT:
      return {Kind::constraint, message};
    case SQLITE_CORRUPT:
      return {Kind::damaged, "the database is damaged: " + message};
    case SQLITE_NOTADB:
      return {Kind::not_a_database, message};
    default:
      return {Kind::other, message};
  }
}

[[noreturn]] void fail(sqlite3* connection, int code) {
  throw failure(code, connection != nullptr ? sqlite3_errmsg(connection) : sqlite3_errstr(code));
}

// --- Digests of rows

std::uint64_t hash_of(std::uint64_t hash, const void* bytes, int size) {
  return base::hash_bytes({static_cast<const std::byte*>(bytes), static_cast<std::size_t>(size)}, hash);
}

// A null adds nothing, so that a column that is added later changes no digest. A whole number is the same as an
// integer and as a real: SQLite stores it as it likes.
std::uint64_t with_value(std::uint64_t hash, int column, bool without_blobs, sqlite3_value* value) {
  const int type = sqlite3_value_type(value);
  if (type == SQLITE_NULL || (without_blobs && type == SQLITE_BLOB)) return hash;
  hash = base::hash_combine(hash, static_cast<std::uint64_t>(column));
  if (type == SQLITE_INTEGER)
    return base::hash_combine(hash, static_cast<std::uint64_t>(sqlite3_value_int64(value)));
  if (type == SQLITE_FLOAT) {
    constexpr double kWhole = 9007199254740992.0;  // 2^53
    const double real = sqlite3_value_double(value);
    if (real >= -kWhole && real <= kWhole && real == static_cast<double>(static_cast<std::int64_t>(real)))
      return base::hash_combine(hash, static_cast<std::uint64_t>(static_cast<std::int64_t>(real)));
    return base::hash_combine(hash, real);
  }
  hash = base::hash_combine(hash, static_cast<std::uint64_t>(type));
  return type == SQLITE_TEXT ? hash_of(hash, sqlite3_value_text(value), sqlite3_value_bytes(value))
                             : hash_of(hash, sqlite3_value_blob(value), sqlite3_value_bytes(value));
}

std::string text_of(sqlite3_value* value) {
  const unsigned char* text = sqlite3_value_text(value);
  return text == nullptr ? std::string()
                         : std::string(reinterpret_cast<const char*>(text),
                                       static_cast<std::size_t>(sqlite3_value_bytes(value)));
}

template <typename Value>
std::pair<std::string, std::uint64_t> digest_of(std::string_view table, int columns, const Value& value) {
  const bool has_checksum = table.ends_with("_chunk");  // of its bytes, which need not be read again
  std::pair<std::string, std::uint64_t> digest{text_of(value(0)), 0};
  if (told_by_two(table)) digest.first += '/' + text_of(value(1));
  for (int i = 0; i < columns; ++i) digest.second = with_value(digest.second, i, has_checksum, value(i));
  return digest;
}

}  // namespace

bool has_digest(std::string_view table) noexcept {
  return table != "digest" && table != "erasing";  // empty but within a transaction
}

bool told_by_two(std::string_view table) noexcept {
  return table == "enrolment" || table == "programme_director" || table == "replay_watched" ||
         table == "standard_attempt" || table == "study_researcher" || table == "study_enrolment";
}

// What the transaction under way changed: for whom, and by how much the digests of table and id differ.
struct Sqlite::Changes {
  std::map<std::pair<std::string, std::string>, std::uint64_t> digests;
  std::set<std::pair<std::string, std::string>> fewer;  // of whom rows went
  bool watched = false;

  static void note(void* self, sqlite3* connection, int operation, const char* schema, const char* table_name,
                   sqlite3_int64, sqlite3_int64) {
    auto& changes = *static_cast<Changes*>(self);
    const std::string_view table(table_name);
    if (!changes.watched || std::string_view(schema) != "main" || !has_digest(table)) return;
    const int columns = sqlite3_preupdate_count(connection);
    const auto add = [&](auto read) {
      const auto [id, hash] = digest_of(table, columns, [&](int column) {
        sqlite3_value* value = nullptr;
        CHECK(read(connection, column, &value) == SQLITE_OK);
        return value;
      });
      const std::pair whose(std::string(table), id);
      changes.digests[whose] ^= hash;
      return whose;
    };
    std::optional<std::pair<std::string, std::string>> before, now;
    if (operation != SQLITE_INSERT) before = add(&sqlite3_preupdate_old);
    if (operation != SQLITE_DELETE) now = add(&sqlite3_preupdate_new);
    if (before && before != now) changes.fewer.insert(*before);
  }
};

// --- Statement
// ----------------------------------------------------------------------------------------------------
void Statement::Finalize::operator()(sqlite3_stmt* statement) const noexcept {
  sqlite3_finalize(statement);
}

Statement::Statement(sqlite3* connection, std::string_view sql) : connection_(connection) {
  sqlite3_stmt* statement = nullptr;
  const char* tail = nullptr;
  const int code = sqlite3_prepare_v2(connection, sql.data(), static_cast<int>(sql.size()), &statement, &tail);
  statement_.reset(statement);
  check(code);
  CHECK(statement != nullptr);
  const std::string_view rest(tail, sql.size() - static_cast<std::size_t>(tail - sql.data()));
  CHECK(rest.find_first_not_of(" \t\r\n;") == std::string_view::npos);
  for (int i = 0; i < sqlite3_column_count(statement); ++i) columns_.emplace(sqlite3_column_name(statement, i), i);
}

void Statement::check(int code) const {
  if (code != SQLITE_OK) fail(connection_, code);
}

int Statement::parameter(std::string_view name) const {
  std::string marked(1, ':');
  marked += name;
  const int index = sqlite3_bind_parameter_index(statement_.get(), marked.c_str());
  CHECK(index > 0);
  return index;
}

int Statement::column(std::string_view name) const {
  const auto found = columns_.find(name);
  // Our questions name their columns, but what a table or a view calls them stands in the file.
  if (found == columns_.end())
    throw DatabaseFailure(DatabaseFailure::Kind::damaged, "the database is damaged: a table lacks a column");
  return found->second;
}

Statement& Statement::bind(std::string_view name, std::string_view text) {
  const char* data = text.data() != nullptr ? text.data() : "";  // a null pointer would bind NULL
  check(sqlite3_bind_text64(statement_.get(), parameter(name), data, text.size(), SQLITE_TRANSIENT, SQLITE_UTF8));
  return *this;
}

Statement& Statement::bind(std::string_view name, std::int64_t value) {
  check(sqlite3_bind_int64(statement_.get(), parameter(name), value));
  return *this;
}

Statement& Statement::bind(std::string_view name, double value) {
  check(sqlite3_bind_double(statement_.get(), parameter(name), value));
  return *this;
}

Statement& Statement::bind(std::string_view name, std::span<const std::byte> bytes) {
  if (bytes.empty())
    check(sqlite3_bind_zeroblob(statement_.get(), parameter(name), 0));
  else
    check(sqlite3_bind_blob64(statement_.get(), parameter(name), bytes.data(), bytes.size(), SQLITE_TRANSIENT));
  return *this;
}

Statement& Statement::bind_null(std::string_view name) {
  check(sqlite3_bind_null(statement_.get(), parameter(name)));
  return *this;
}

Statement& Statement::bind_value(std::string_view name, const Statement& from) {
  check(sqlite3_bind_value(statement_.get(), parameter(name),
                           sqlite3_column_value(from.statement_.get(), from.column(name))));
  return *this;
}

bool Statement::step() {
  const int code = sqlite3_step(statement_.get());
  if (code == SQLITE_ROW) return true;
  if (code == SQLITE_DONE) return false;
  const DatabaseFailure why = failure(code, sqlite3_errmsg(connection_));
  sqlite3_reset(statement_.get());
  throw why;
}

void Statement::run() {
  CHECK(!step());
  rewind();
}

void Statement::rewind() {
  sqlite3_reset(statement_.get());
}

bool Statement::is_null(std::string_view name) const {
  return sqlite3_column_type(statement_.get(), column(name)) == SQLITE_NULL;
}

std::string_view Statement::view(std::string_view name) const {
  const int index = column(name);
  const unsigned char* data = sqlite3_column_text(statement_.get(), index);
  if (data == nullptr) return {};
  return {reinterpret_cast<const char*>(data),
          static_cast<std::size_t>(sqlite3_column_bytes(statement_.get(), index))};
}

std::string Statement::text(std::string_view name) const {
  return std::string(view(name));
}

std::int64_t Statement::integer(std::string_view name) const {
  return sqlite3_column_int64(statement_.get(), column(name));
}

int Statement::small_integer(std::string_view name) const {
  const std::int64_t value = integer(name);
  if (value < std::numeric_limits<int>::min() || value > std::numeric_limits<int>::max())
    throw DatabaseFailure(DatabaseFailure::Kind::damaged, "the database is damaged: a number is out of its range");
  return static_cast<int>(value);
}

double Statement::real(std::string_view name) const {
  return sqlite3_column_double(statement_.get(), column(name));
}

std::vector<std::byte> Statement::bytes(std::string_view name) const {
  const int index = column(name);
  const auto* data = static_cast<const std::byte*>(sqlite3_column_blob(statement_.get(), index));
  const auto size = static_cast<std::size_t>(sqlite3_column_bytes(statement_.get(), index));
  return data == nullptr ? std::vector<std::byte>{} : std::vector<std::byte>(data, data + size);
}

Statement::Kind Statement::kind(std::string_view name) const {
  switch (sqlite3_column_type(statement_.get(), column(name))) {
    case SQLITE_INTEGER:
      return Kind::integer;
    case SQLITE_FLOAT:
      return Kind::real;
    case SQLITE_TEXT:
      return Kind::text;
    case SQLITE_BLOB:
      return Kind::blob;
    default:
      return Kind::null;
  }
}

std::pair<std::string, std::uint64_t> Statement::digest(std::string_view table) const {
  return digest_of(table, sqlite3_column_count(statement_.get()),
                   [&](int column) { return sqlite3_column_value(statement_.get(), column); });
}

// --- Sqlite
// -------------------------------------------------------------------------------------------------------
void Sqlite::Close::operator()(sqlite3* connection) const noexcept {
  sqlite3_close(connection);
}

namespace {

// The name as a URI, in which no letter of it means anything (sqlite.org/uri.html).
std::string immutable_uri(const std::filesystem::path& file) {
  constexpr const char* kDigits = "0123456789abcdef";
  std::string uri = "file:";
  for (const char letter : std::filesystem::absolute(file).string()) {
    const auto byte = static_cast<unsigned char>(letter);
    if (letter == '/')
      uri += letter;
    else
      (uri += '%') += {kDigits[byte >> 4U], kDigits[byte & 15U]};
  }
  return uri + "?immutable=1";
}

}  // namespace

Sqlite::Sqlite(const std::filesystem::path& file, Mode mode) : file_(file), changes_(std::make_shared<Changes>()) {
  sqlite3* connection = nullptr;
  const bool reads_only = mode == Mode::read_only || mode == Mode::immutable;
  const int flags = SQLITE_OPEN_EXRESCODE | SQLITE_OPEN_FULLMUTEX |
                    (reads_only ? SQLITE_OPEN_READONLY | SQLITE_OPEN_URI : SQLITE_OPEN_READWRITE) |
                    (mode == Mode::create ? SQLITE_OPEN_CREATE : 0);
  const std::string name = mode == Mode::immutable ? immutable_uri(file) : file.string();
  const int code = sqlite3_open_v2(name.c_str(), &connection, flags, nullptr);
  connection_.reset(connection);
  if (code != SQLITE_OK) fail(connection, code);
  read_only_ = reads_only;
  sqlite3_preupdate_hook(connection, &Changes::note, changes_.get());
  sqlite3_busy_timeout(connection, 5000);
  // A damaged or hostile file must not make SQLite run code of its own or write through its schema.
  sqlite3_db_config(connection, SQLITE_DBCONFIG_DEFENSIVE, 1, nullptr);
  sqlite3_db_config(connection, SQLITE_DBCONFIG_DQS_DML, 0, nullptr);
  sqlite3_db_config(connection, SQLITE_DBCONFIG_DQS_DDL, 0, nullptr);
  run("PRAGMA trusted_schema = OFF; PRAGMA cell_size_check = ON; PRAGMA foreign_keys = ON;"
      "PRAGMA recursive_triggers = ON;");
  try {
    run("PRAGMA synchronous = FULL");
  } catch (const DatabaseFailure& failure) {
    // This one reads the file. What is no database or damaged is told to whoever asks it next: schema_version()
    // refuses it.
    if (failure.kind() != DatabaseFailure::Kind::not_a_database && failure.kind() != DatabaseFailure::Kind::damaged)
      throw;
  }
}

Statement Sqlite::prepare(std::string_view sql) {
  return Statement(connection_.get(), sql);
}

void Sqlite::run(const std::string& script) {
  const int code = sqlite3_exec(connection_.get(), script.c_str(), nullptr, nullptr, nullptr);
  if (code != SQLITE_OK) fail(connection_.get(), code);
}

std::int64_t Sqlite::integer(std::string_view sql) {
  Statement statement = prepare(sql);
  CHECK(statement.step());
  return sqlite3_column_int64(statement.statement_.get(), 0);
}

std::string Sqlite::text(std::string_view sql) {
  Statement statement = prepare(sql);
  CHECK(statement.step());
  const unsigned char* data = sqlite3_column_text(statement.statement_.get(), 0);
  return data == nullptr ? std::string() : std::string(reinterpret_cast<const char*>(data));
}

void Sqlite::forget_changes() noexcept {
  changes_->digests.clear();
  changes_->fewer.clear();
}

void Sqlite::write_digests() {
  const auto changed = std::exchange(changes_->digests, {});
  const auto fewer = std::exchange(changes_->fewer, {});
  if (changed.empty() || !has_digests(*this)) return;
  // XOR, whose order does not matter and which takes away what it added.
  for (const auto& [whose, sum] : changed)
    if (sum != 0) change_digest(*this, whose, sum);
  // A row that had been damaged leaves its damage in the digest; with the last row that goes too.
  for (const auto& whose : fewer) forget_if_gone(*this, whose);
}

Sqlite::Unguarded::Unguarded(Sqlite& database) : database_(database) {
  guard(false);
}

Sqlite::Unguarded::~Unguarded() {
  guard(true);
}

void Sqlite::Unguarded::guard(bool on) noexcept {
  sqlite3_db_config(database_.connection_.get(), SQLITE_DBCONFIG_ENABLE_TRIGGER, on ? 1 : 0, nullptr);
  sqlite3_db_config(database_.connection_.get(), SQLITE_DBCONFIG_ENABLE_FKEY, on ? 1 : 0, nullptr);
}

bool Sqlite::in_transaction() const noexcept {
  return sqlite3_get_autocommit(connection_.get()) == 0;
}

bool Sqlite::read_only() const noexcept {
  return read_only_ || sqlite3_db_readonly(connection_.get(), "main") == 1;
}

void Sqlite::copy_to(Sqlite& other) {
  sqlite3_backup* backup = sqlite3_backup_init(other.connection_.get(), "main", connection_.get(), "main");
  if (backup == nullptr) fail(other.connection_.get(), sqlite3_errcode(other.connection_.get()));
  // All pages in one step: with a write-ahead log that is one state, and writers are not held up. The time limit of
  // the connection does not count here, so the waiting for locks is ours.
  int code = SQLITE_BUSY;
  for (int round = 0; round < 500 && (code == SQLITE_BUSY || code == SQLITE_LOCKED); ++round) {
    if (round > 0) sqlite3_sleep(10);
    code = sqlite3_backup_step(backup, -1);
  }
  const int end = sqlite3_backup_finish(backup);
  if (code != SQLITE_DONE) throw failure(code, sqlite3_errstr(code));
  if (end != SQLITE_OK) throw failure(end, sqlite3_errstr(end));
}

// --- Transaction
// --------------------------------------------------------------------------------------------------
Transaction::Transaction(Sqlite& database) : database_(database) {
  CHECK(!database.in_transaction());
  if (database.read_only_)
    throw base::Failure("read_only", "the library can only be read: its disk or its folder is write-protected");
  database.run("BEGIN IMMEDIATE");
  database.forget_changes();
  database.changes_->watched = true;
}

Transaction::~Transaction() {
  database_.changes_->watched = false;
  if (!database_.in_transaction()) return;  // committed, or SQLite itself rolled back
  try {
    database_.run("ROLLBACK");
  } catch (const base::Failure&) {
    // What is not committed is not there for anybody; the next BEGIN says what is wrong.
  }
}

void Transaction::commit() {
  database_.write_digests();
  database_.run("COMMIT");
}

Snapshot::Snapshot(Sqlite& database) : database_(database), own_(!database.in_transaction()) {
  if (own_) database.run("BEGIN");
}

Snapshot::~Snapshot() {
  if (!own_) return;
  try {
    database_.run("ROLLBACK");
  } catch (const base::Failure&) {
    // Nothing was written.
  }
}

}  // namespace seldinger::casedb
