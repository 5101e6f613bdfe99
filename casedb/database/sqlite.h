// The only door of SQLite: a connection, a statement, a transaction. One thread at a time uses a connection.
// Whatever goes wrong throws DatabaseFailure with SQLite's message, which names tables and columns but no values.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "sim/base/failure.h"

struct sqlite3;
struct sqlite3_stmt;

namespace seldinger::casedb {

// code() is "disk" when the file system fails (full, not writable, input/output error), otherwise "database".
class DatabaseFailure : public base::Failure {
 public:
  enum class Kind { other, disk, busy, constraint, damaged, not_a_database };
  DatabaseFailure(Kind kind, const std::string& text)
      : base::Failure(kind == Kind::disk ? "disk" : "database", text), kind_(kind) {}
  Kind kind() const noexcept { return kind_; }

 private:
  Kind kind_;
};

bool has_digest(std::string_view table) noexcept;
// Digests tell the rows of a table by their first column, or by two where a row can go while others of the first
// column stay: its damage goes with it.
bool told_by_two(std::string_view table) noexcept;

// One prepared question. Parameters and columns go by name: `:case_id` in SQL is bind("case_id", …).
class Statement {
 public:
  Statement& bind(std::string_view name, std::string_view text);
  Statement& bind(std::string_view name, const char* text) { return bind(name, std::string_view(text)); }
  Statement& bind(std::string_view name, const std::string& text) { return bind(name, std::string_view(text)); }
  Statement& bind(std::string_view name, std::int64_t value);
  Statement& bind(std::string_view name, int value) { return bind(name, std::int64_t{value}); }
  Statement& bind(std::string_view name, double value);
  Statement& bind(std::string_view name, std::span<const std::byte> bytes);
  Statement& bind_null(std::string_view name);
  Statement& bind_value(std::string_view column, const Statement& from);  // as it is in the other's row
  template <typename T>
  Statement& bind(std::string_view name, const std::optional<T>& value) {
    return value.has_value() ? bind(name, *value) : bind_null(name);
  }

  bool step();    // true: a row is there to be read
  void run();     // for statements without rows; then ready for the next values
  void rewind();  // ready for the next values; those bound stay

  bool is_null(std::string_view column) const;
  std::string text(std::string_view column) const;       // empty for null
  std::string_view view(std::string_view column) const;  // as text, until the next step or rewind
  std::int64_t integer(std::string_view column) const;
  int small_integer(std::string_view column) const;  // damaged, where it does not fit
  double real(std::string_view column) const;
  std::vector<std::byte> bytes(std::string_view column) const;

  enum class Kind { null, integer, real, text, blob };
  Kind kind(std::string_view column) const;
  // Of a row with all columns of a table in the table's order: whose it is, and the digest of what it holds
  // (digests.h).
  std::pair<std::string, std::uint64_t> digest(std::string_view table) const;

 private:
  friend class Sqlite;
  struct Finalize {
    void operator()(sqlite3_stmt* statement) const noexcept;
  };
  Statement(sqlite3* connection, std::string_view sql);
  int parameter(std::string_view name) const;
  int column(std::string_view name) const;
  void check(int code) const;

  sqlite3* connection_;
  std::unique_ptr<sqlite3_stmt, Finalize> statement_;
  std::map<std::string, int, std::less<>> columns_;  // own: SQLite frees its names when the schema has changed
};

class Sqlite {
 public:
  // Immutable: nobody at all writes the file, so that neither locks nor a log are needed.
  enum class Mode { existing, create, read_only, immutable };
  // Foreign keys are enforced, writes are durable when they return, another writer is waited for up to 5 s.
  explicit Sqlite(const std::filesystem::path& file, Mode mode = Mode::existing);

  const std::filesystem::path& file() const noexcept { return file_; }
  Statement prepare(std::string_view sql);  // CHECKs that it is one statement
  void run(const std::string& script);      // several statements without parameters
  std::int64_t integer(std::string_view sql);
  std::string text(std::string_view sql);
  bool in_transaction() const noexcept;
  bool read_only() const noexcept;
  // Makes `other` this database as it is now, page by page, while others read and write here (SQLite's online
  // backup). Whatever was in `other` is gone.
  void copy_to(Sqlite& other);

  // From here on a Transaction is refused: `read_only`.
  void refuse_writing() noexcept { read_only_ = true; }
  // Triggers and foreign keys rest in its lifetime: for what was checked otherwise.
  class Unguarded;
  // Writes the digests of the rows changed so far by the transaction under way, as its commit does.
  void write_digests();
  void forget_changes() noexcept;  // somebody else writes their digests

 private:
  friend class Transaction;
  struct Changes;  // by the transaction under way
  struct Close {
    void operator()(sqlite3* connection) const noexcept;
  };
  std::filesystem::path file_;
  bool read_only_ = false;
  std::shared_ptr<Changes> changes_;  // outlives the connection
  std::unique_ptr<sqlite3, Close> connection_;
};

class Sqlite::Unguarded {
 public:
  explicit Unguarded(Sqlite& database);
  Unguarded(const Unguarded&) = delete;
  Unguarded& operator=(const Unguarded&) = delete;
  ~Unguarded();

 private:
  void guard(bool on) noexcept;
  Sqlite& database_;
};

// A write transaction: takes the write lock at once, so that what it reads still holds when it writes. Rolled back
// unless committed, and with it go the digests of what it changed. Throws Failure("read_only") where nothing can be
// written.
class Transaction {
 public:
  explicit Transaction(Sqlite& database);
  Transaction(const Transaction&) = delete;
  Transaction& operator=(const Transaction&) = delete;
  ~Transaction();
  void commit();

 private:
  Sqlite& database_;
};

// What is read in its lifetime is one state of the database, while others go on writing. Within a transaction that
// is the transaction's.
class Snapshot {
 public:
  explicit Snapshot(Sqlite& database);
  Snapshot(const Snapshot&) = delete;
  Snapshot& operator=(const Snapshot&) = delete;
  ~Snapshot();

 private:
  Sqlite& database_;
  bool own_;
};

}  // namespace seldinger::casedb
