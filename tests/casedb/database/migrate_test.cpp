// Migrations: a new file walks all steps, an old one is copied first, a failing step leaves nothing, and what is
// not ours is refused untouched.
#include "casedb/database/migrate.h"

#include <sys/stat.h>

#include "tests/casedb/library_samples.h"

namespace seldinger::casedb {
namespace {

constexpr std::int32_t kId = 0x54455354;
constexpr base::EmbeddedFile kSteps[] = {
    {"0001_initial.sql", "CREATE TABLE a (x INTEGER NOT NULL) STRICT;"},
    {"0002_more.sql", "CREATE TABLE b (y INTEGER NOT NULL) STRICT; INSERT INTO b SELECT x + 1 FROM a;"},
    {"0003_less.sql", "DROP TABLE a;"},
};
constexpr base::EmbeddedFile kBrokenSteps[] = {
    kSteps[0],
    {"0002_more.sql", "CREATE TABLE b (y INTEGER NOT NULL) STRICT; DROP TABLE a; INSERT INTO b VALUES (NULL);"},
};

Schema first_steps(std::size_t count) {
  return {kId, std::span(kSteps).first(count)};
}

class MigrateTest : public testing::Test {
 protected:
  std::filesystem::path folder_ = fresh_folder();
  std::filesystem::path file_ = folder_ / "a.sqlite";

  void make_version(std::size_t count) {
    Sqlite database(file_, Sqlite::Mode::create);
    ASSERT_TRUE(migrate(database, first_steps(count)));
    database.run("INSERT INTO a VALUES (41)");
  }
  std::string refusal(const Schema& schema) {
    Sqlite database(file_);
    const auto result = migrate(database, schema);
    return result ? "none" : result.error().code;
  }
};

TEST_F(MigrateTest, ANewFileWalksAllSteps) {
  Sqlite database(file_, Sqlite::Mode::create);
  EXPECT_EQ(schema_version(database, first_steps(3)).value(), 0);
  ASSERT_TRUE(migrate(database, first_steps(3)));
  EXPECT_EQ(schema_version(database, first_steps(3)).value(), 3);
  EXPECT_EQ(database.integer("PRAGMA application_id"), kId);
  EXPECT_EQ(database.text("PRAGMA journal_mode"), "wal");
  EXPECT_EQ(database.text("SELECT group_concat(name) FROM sqlite_schema"), "b");
  EXPECT_FALSE(std::filesystem::exists(file_.string() + ".v0-backup"));
}

TEST_F(MigrateTest, AnOldFileIsCopiedAndThenWalksTheMissingSteps) {
  make_version(1);
  ::chmod(file_.c_str(), 0600);
  {
    Sqlite database(file_);
    ASSERT_TRUE(migrate(database, first_steps(3)));
    EXPECT_EQ(database.integer("SELECT y FROM b"), 42);
    ASSERT_TRUE(migrate(database, first_steps(3)));  // nothing left to do
  }
  const auto backup = file_.string() + ".v1-backup";
  struct stat about {};
  ASSERT_EQ(::stat(backup.c_str(), &about), 0);
  EXPECT_EQ(about.st_mode & 0777U, 0600U);
  Sqlite copy(backup);
  EXPECT_EQ(schema_version(copy, first_steps(1)).value(), 1);
  EXPECT_EQ(copy.integer("SELECT x FROM a"), 41);
  EXPECT_EQ(contents_of(folder_).count("a.sqlite.v1-backup-2"), 0U);
}

TEST_F(MigrateTest, ACopyNeverOverwritesAnother) {
  make_version(1);
  std::ofstream(file_.string() + ".v1-backup") << "older";
  EXPECT_EQ(refusal(first_steps(2)), "none");
  EXPECT_EQ(fixtures::whole_file(file_.string() + ".v1-backup"), "older");
  Sqlite copy(file_.string() + ".v1-backup-2");
  EXPECT_EQ(copy.integer("SELECT x FROM a"), 41);
}

TEST_F(MigrateTest, AFailingStepLeavesTheVersionBefore) {
  make_version(1);
  Sqlite database(file_);
  EXPECT_THROW(static_cast<void>(migrate(database, {kId, kBrokenSteps})), DatabaseFailure);
  EXPECT_EQ(schema_version(database, first_steps(3)).value(), 1);
  EXPECT_EQ(database.integer("SELECT x FROM a"), 41);
  EXPECT_EQ(database.text("SELECT group_concat(name) FROM sqlite_schema"), "a");
}

TEST_F(MigrateTest, ANewerSchemaIsRefusedUntouched) {
  make_version(1);
  EXPECT_EQ(refusal(first_steps(2)), "none");
  const std::string before = fixtures::whole_file(file_);
  EXPECT_EQ(refusal(first_steps(1)), "newer_schema");
  EXPECT_EQ(fixtures::whole_file(file_), before);
}

TEST_F(MigrateTest, AnotherProgramsDatabaseIsRefusedUntouched) {
  {
    Sqlite database(file_, Sqlite::Mode::create);
    database.run("CREATE TABLE theirs (x INTEGER); PRAGMA user_version = 1");
  }
  const std::string before = fixtures::whole_file(file_);
  EXPECT_EQ(refusal(first_steps(1)), "not_a_library");
  {
    Sqlite database(file_);
    database.run("PRAGMA application_id = 99");
  }
  EXPECT_EQ(refusal(first_steps(1)), "not_a_library");
  EXPECT_EQ(fixtures::whole_file(file_).size(), before.size());
  Sqlite database(file_);
  EXPECT_EQ(database.text("PRAGMA journal_mode"), "delete");
  EXPECT_EQ(database.text("SELECT group_concat(name) FROM sqlite_schema"), "theirs");
}

TEST_F(MigrateTest, WhatIsNoDatabaseIsRefusedUntouched) {
  const std::string text(5000, 'x');
  std::ofstream(file_) << text;
  EXPECT_EQ(refusal(first_steps(1)), "not_a_library");
  EXPECT_EQ(fixtures::whole_file(file_), text);
}

TEST_F(MigrateTest, ADamagedFileIsRefused) {
  make_version(1);
  const std::string good = fixtures::whole_file(file_);
  ASSERT_EQ(good.size(), 8192U);  // page 1: header and schema; page 2: table a
  for (const auto& [from, count] : {std::pair(100UL, 200UL), std::pair(4096UL, 300UL), std::pair(200UL, 7992UL)}) {
    std::string bad = good;
    bad.replace(from, count, std::string(count, '\x55'));
    std::ofstream(file_, std::ios::binary) << bad;
    EXPECT_EQ(refusal(first_steps(1)), "damaged") << "from byte " << from;
  }
  std::ofstream(file_, std::ios::binary) << good.substr(0, 4096);
  EXPECT_EQ(refusal(first_steps(1)), "damaged");
  std::ofstream(file_, std::ios::binary) << good;
  EXPECT_EQ(refusal(first_steps(1)), "none");
}

}  // namespace
}  // namespace seldinger::casedb
