#include "casedb/database/sqlite.h"

#include <sqlite3.h>

#include <limits>

#include "sim/base/check.h"

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

}  // namespace

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
  CHECK(found != columns_.end());
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
  CHECK(value >= std::numeric_limits<int>::min() && value <= std::numeric_limits<int>::max());
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

// --- Sqlite
// -------------------------------------------------------------------------------------------------------
void Sqlite::Close::operator()(sqlite3* connection) const noexcept {
  sqlite3_close(connection);
}

Sqlite::Sqlite(const std::filesystem::path& file, Mode mode) : file_(file) {
  sqlite3* connection = nullptr;
  const int flags = SQLITE_OPEN_READWRITE | SQLITE_OPEN_EXRESCODE | SQLITE_OPEN_FULLMUTEX |
                    (mode == Mode::create ? SQLITE_OPEN_CREATE : 0);
  const int code = sqlite3_open_v2(file.c_str(), &connection, flags, nullptr);
  connection_.reset(connection);
  if (code != SQLITE_OK) fail(connection, code);
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

bool Sqlite::in_transaction() const noexcept {
  return sqlite3_get_autocommit(connection_.get()) == 0;
}

bool Sqlite::read_only() const noexcept {
  return sqlite3_db_readonly(connection_.get(), "main") == 1;
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
  database.run("BEGIN IMMEDIATE");
}

Transaction::~Transaction() {
  if (!database_.in_transaction()) return;  // committed, or SQLite itself rolled back
  try {
    database_.run("ROLLBACK");
  } catch (const base::Failure&) {
    // What is not committed is not there for anybody; the next BEGIN says what is wrong.
  }
}

void Transaction::commit() {
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
