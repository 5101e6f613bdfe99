// The door of SQLite: settings of every connection, values that come back as they went in, transactions, failures.
#include "casedb/database/sqlite.h"

#include <sqlite3.h>

#include <atomic>
#include <functional>
#include <limits>
#include <thread>

#include "tests/casedb/library_samples.h"
#include "tests/fixtures/until.h"

namespace seldinger::casedb {
namespace {

class SqliteTest : public testing::Test {
 protected:
  std::filesystem::path folder_ = fresh_folder();
  Sqlite database_{folder_ / "a.sqlite", Sqlite::Mode::create};
};

TEST_F(SqliteTest, EveryConnectionHasTheSafeSettings) {
  EXPECT_EQ(database_.integer("PRAGMA foreign_keys"), 1);
  EXPECT_EQ(database_.integer("PRAGMA synchronous"), 2);  // FULL
  EXPECT_EQ(database_.integer("PRAGMA busy_timeout"), 5000);
  EXPECT_EQ(database_.integer("PRAGMA trusted_schema"), 0);
  EXPECT_EQ(database_.integer("PRAGMA cell_size_check"), 1);
  EXPECT_EQ(database_.integer("PRAGMA recursive_triggers"), 1);
}

TEST_F(SqliteTest, AMissingFileIsNotMade) {
  EXPECT_THROW(Sqlite(folder_ / "b.sqlite"), DatabaseFailure);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "b.sqlite"));
}

TEST_F(SqliteTest, ValuesComeBackAsTheyWentIn) {
  database_.run("CREATE TABLE t (a TEXT, b INTEGER, c REAL, d BLOB, e TEXT) STRICT");
  const std::string text("a\0b'; DROP TABLE t; -- é", 25);
  const std::vector<std::byte> bytes{std::byte{0}, std::byte{255}, std::byte{39}};
  const double tiny = std::numeric_limits<double>::denorm_min();
  database_.prepare("INSERT INTO t VALUES (:a, :b, :c, :d, :e)")
      .bind("a", text)
      .bind("b", std::numeric_limits<std::int64_t>::min())
      .bind("c", tiny)
      .bind("d", std::span(bytes))
      .bind_null("e")
      .run();
  Statement row = database_.prepare("SELECT * FROM t");
  ASSERT_TRUE(row.step());
  EXPECT_EQ(row.text("a"), text);
  EXPECT_EQ(row.integer("b"), std::numeric_limits<std::int64_t>::min());
  EXPECT_TRUE(same_bits(row.real("c"), tiny));
  EXPECT_EQ(row.bytes("d"), bytes);
  EXPECT_TRUE(row.is_null("e"));
  EXPECT_FALSE(row.step());
}

// Was: the program ended. A turned bit in a table's definition renames a column, one in a number makes it large.
TEST_F(SqliteTest, AnotherColumnAndALargeNumberAreDamage) {
  database_.run("CREATE TABLE t (a INTEGER) STRICT; INSERT INTO t VALUES (4294967297)");
  Statement row = database_.prepare("SELECT * FROM t");
  ASSERT_TRUE(row.step());
  for (const auto& read :
       {std::function<void()>([&] { row.small_integer("a"); }), std::function<void()>([&] { row.integer("b"); })}) {
    try {
      read();
      ADD_FAILURE() << "was read";
    } catch (const DatabaseFailure& failure) {
      EXPECT_EQ(failure.kind(), DatabaseFailure::Kind::damaged);
    }
  }
}

TEST_F(SqliteTest, EmptyTextAndBytesAreNotNull) {
  database_.run("CREATE TABLE t (a TEXT NOT NULL, d BLOB NOT NULL) STRICT");
  database_.prepare("INSERT INTO t VALUES (:a, :d)")
      .bind("a", std::string_view())
      .bind("d", std::span<const std::byte>())
      .run();
  EXPECT_EQ(database_.integer("SELECT count(*) FROM t"), 1);
}

TEST_F(SqliteTest, NotANumberBecomesNull) {  // which NOT NULL and CHECK then refuse
  database_.run("CREATE TABLE t (c REAL NOT NULL) STRICT");
  Statement insert = database_.prepare("INSERT INTO t VALUES (:c)");
  insert.bind("c", std::numeric_limits<double>::quiet_NaN());
  EXPECT_TRUE(refused_by_constraint([&] { insert.run(); }));
}

TEST_F(SqliteTest, ATransactionIsRolledBackUnlessCommitted) {
  database_.run("CREATE TABLE t (a INTEGER) STRICT");
  {
    Transaction transaction(database_);
    database_.run("INSERT INTO t VALUES (1)");
  }
  EXPECT_EQ(database_.integer("SELECT count(*) FROM t"), 0);
  {
    Transaction transaction(database_);
    database_.run("INSERT INTO t VALUES (1)");
    transaction.commit();
  }
  EXPECT_EQ(database_.integer("SELECT count(*) FROM t"), 1);
  EXPECT_FALSE(database_.in_transaction());
}

TEST_F(SqliteTest, AFailureTellsTableAndColumnButNoValue) {
  database_.run("CREATE TABLE t (a TEXT UNIQUE) STRICT; INSERT INTO t VALUES ('Jane Doe')");
  try {
    database_.prepare("INSERT INTO t VALUES (:a)").bind("a", "Jane Doe").run();
    FAIL() << "was accepted";
  } catch (const DatabaseFailure& failure) {
    EXPECT_EQ(failure.code(), "database");
    EXPECT_EQ(failure.kind(), DatabaseFailure::Kind::constraint);
    EXPECT_NE(std::string(failure.what()).find("t.a"), std::string::npos);
    EXPECT_EQ(std::string(failure.what()).find("Jane"), std::string::npos);
  }
}

TEST_F(SqliteTest, AFailureToWriteIsTheDisks) {
  database_.run("CREATE TABLE t (a INTEGER) STRICT");
  database_.run("PRAGMA max_page_count = 2");
  try {
    database_.run(
        "INSERT INTO t SELECT value FROM (WITH RECURSIVE n(value) AS (SELECT 1 UNION ALL "
        "SELECT value + 1 FROM n WHERE value < 10000) SELECT value FROM n)");
    FAIL() << "was accepted";
  } catch (const base::Failure& failure) {
    EXPECT_EQ(failure.code(), "disk");
    EXPECT_STREQ(failure.what(), "the disk is full");
  }
}

// SQLite's own file system, which counts how often a connection sleeps since another holds its lock.
class SleepCounter {
 public:
  SleepCounter() {
    sleeps = 0;
    own_ = *usual();
    own_.zName = "counts sleeps";
    own_.xSleep = [](sqlite3_vfs*, int us) {
      ++sleeps;
      return usual()->xSleep(usual(), us);
    };
    EXPECT_EQ(sqlite3_vfs_register(&own_, 1), SQLITE_OK);
  }
  ~SleepCounter() { sqlite3_vfs_unregister(&own_); }
  SleepCounter(const SleepCounter&) = delete;
  SleepCounter& operator=(const SleepCounter&) = delete;

  static inline std::atomic<int> sleeps{0};

 private:
  static sqlite3_vfs* usual() { return sqlite3_vfs_find("unix"); }
  sqlite3_vfs own_{};
};

TEST_F(SqliteTest, AWriterWaitsForAnother) {
  const SleepCounter counter;
  database_.run("PRAGMA journal_mode = WAL");
  database_.run("CREATE TABLE t (a INTEGER) STRICT");
  auto first = std::make_unique<Transaction>(database_);
  std::thread second([&] {
    Sqlite other(folder_ / "a.sqlite");
    Transaction transaction(other);
    other.run("INSERT INTO t VALUES (2)");
    transaction.commit();
  });
  EXPECT_TRUE(fixtures::until([&] { return SleepCounter::sleeps > 0; })) << "the second found no lock";
  database_.run("INSERT INTO t VALUES (1)");
  first->commit();
  first.reset();
  second.join();
  EXPECT_EQ(database_.integer("SELECT count(*) FROM t"), 2);
}

TEST_F(SqliteTest, DoubleQuotedTextIsNotAString) {
  EXPECT_THROW(database_.integer("SELECT \"no such column\""), DatabaseFailure);
}

}  // namespace
}  // namespace seldinger::casedb
