// What can be wrong with the place a library lies on and with its database (beside library_test, migrate_test,
// full_disk_test, which have: replaced by a newer schema, another program's, a damaged page, a full disk). Each is
// told in words, and nothing is changed.
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>

#include "casedb/cases/authoring.h"
#include "casedb/database/migrate.h"
#include "casedb/keeping/check.h"
#include "tests/casedb/bundle_samples.h"
#include "tests/casedb/faults/faults.h"
#include "tests/casedb/library_samples.h"

namespace seldinger::casedb {
namespace {

namespace fs = std::filesystem;

class TroubleTest : public testing::Test {
 protected:
  fs::path scratch_ = fresh_folder(), folder_ = scratch_ / "library";

  void SetUp() override { faults::set({}); }
  void TearDown() override {
    faults::set({});
    faults::call_all_file_systems_network(false);
  }
  void make() {
    Library library = open_library(folder_);
    const std::string case_id = add_case(library, sample_case());
    static_cast<void>(add_lesion(library, case_id, sample_lesion()).value());
  }
  std::string outcome() {
    try {
      const auto library = Library::open(folder_);
      return library ? "none" : library.error().code;
    } catch (const base::Failure& failure) {
      return "failure: " + failure.code();
    }
  }
};

TEST_F(TroubleTest, ANetworkFileSystemIsRefusedUntouched) {
  make();
  const auto before = contents_of(folder_);
  faults::call_all_file_systems_network(true);
  EXPECT_EQ(outcome(), "network_file_system");
  EXPECT_EQ(Library::open_or_create(folder_).error().code, "network_file_system");
  EXPECT_EQ(Library::open_or_create(scratch_ / "new").error().code, "network_file_system");
  EXPECT_FALSE(fs::exists(scratch_ / "new"));
  EXPECT_EQ(contents_of(folder_), before);
}

TEST_F(TroubleTest, AReadOnlyDiskIsAFailureOfTheDisk) {
  make();
  const auto before = contents_of(folder_);
  faults::set({faults::Kind::read_only, 0, false});
  EXPECT_EQ(outcome(), "failure: disk");
  try {
    static_cast<void>(Library::open_or_create(scratch_ / "new"));
    FAIL() << "was made";
  } catch (const base::Failure& failure) {
    EXPECT_EQ(failure.code(), "disk");
  }
  faults::set({});
  EXPECT_EQ(contents_of(folder_), before);
  EXPECT_EQ(outcome(), "none");
}

// As a copy of the files of a running library is: its log holds rows that are not in the database's file yet, and
// the shared index is not there.
TEST_F(TroubleTest, ALogWithoutItsIndexIsRecovered) {
  const fs::path copy = scratch_ / "copy";
  {
    Library library = open_library(folder_);
    const std::string case_id = add_case(library, sample_case());
    static_cast<void>(add_lesion(library, case_id, sample_lesion()).value());
    fs::copy(folder_, copy, fs::copy_options::recursive);
    ASSERT_TRUE(fs::exists(copy / "seldinger.sqlite-wal"));
    ASSERT_GT(fs::file_size(copy / "seldinger.sqlite-wal"), 0U);
    fs::remove(copy / "seldinger.sqlite-shm");
  }
  Library library = open_library(copy);
  EXPECT_EQ(list_cases(library).size(), 1U);
  EXPECT_EQ(list_lesions(library, list_cases(library)[0].case_id).size(), 1U);
  EXPECT_TRUE(check_library(copy, false).value().holds());
}

// And the database alone, without its log, is the library as it was before, whole.
TEST_F(TroubleTest, ADatabaseWithoutItsLogIsAnOlderOne) {
  const fs::path copy = scratch_ / "copy";
  make();
  {
    Library library = open_library(folder_);
    static_cast<void>(add_lesion(library, list_cases(library)[0].case_id, sample_lesion()).value());
    fs::copy(folder_, copy, fs::copy_options::recursive);
    fs::remove(copy / "seldinger.sqlite-shm");
    fs::remove(copy / "seldinger.sqlite-wal");
  }
  Library library = open_library(copy);
  EXPECT_EQ(list_lesions(library, list_cases(library)[0].case_id).size(), 1U);
  EXPECT_TRUE(check_library(copy, false).value().holds());
}

TEST_F(TroubleTest, LockedByAnotherProcessIsSaidAfterFiveSeconds) {
  make();
  int ready[2], go[2];
  ASSERT_EQ(::pipe(ready), 0);
  ASSERT_EQ(::pipe(go), 0);
  const pid_t child = ::fork();
  if (child == 0) {
    char byte = 'x';
    ::close(go[1]);
    try {
      Library library = open_library(folder_);
      const Transaction lock(library.database());
      static_cast<void>(faults::real_write(ready[1], &byte, 1));
      if (::read(go[0], &byte, 1) != 0) ::_exit(1);  // until the parent closes its end
    } catch (...) {
    }
    ::_exit(0);
  }
  ::close(go[0]);
  char byte = 0;
  ASSERT_EQ(::read(ready[0], &byte, 1), 1);
  Library library = open_library(folder_);  // reading is not held up
  const std::string case_id = list_cases(library).at(0).case_id;
  const auto start = std::chrono::steady_clock::now();
  try {
    static_cast<void>(add_lesion(library, case_id, sample_lesion()));
    ADD_FAILURE() << "was stored";
  } catch (const DatabaseFailure& failure) {
    EXPECT_EQ(failure.kind(), DatabaseFailure::Kind::busy);
    EXPECT_STREQ(failure.what(), "another program keeps the database locked");
  }
  // Time is what is tested; a busy machine only adds to it.
  EXPECT_GE(std::chrono::steady_clock::now() - start, std::chrono::milliseconds(4900));
  ::close(go[1]);
  ::waitpid(child, nullptr, 0);
  ::close(ready[0]);
  ::close(ready[1]);
  EXPECT_TRUE(add_lesion(library, case_id, sample_lesion()).has_value());
}

TEST_F(TroubleTest, AnotherProgramsMarkIsRefusedUntouched) {
  make();
  { Sqlite(folder_ / "seldinger.sqlite").run("PRAGMA application_id = 1"); }
  const auto before = contents_of(folder_);
  EXPECT_EQ(outcome(), "not_a_library");
  EXPECT_EQ(contents_of(folder_), before);
}

// A library of every schema that was released opens, is copied first, and is whole.
// Beside a sanitizer, where each takes many times as long, every sixth.
#ifdef __SANITIZE_ADDRESS__
constexpr int kSchemaStep = 6, kMigrationsCutShort = 8;
#else
constexpr int kSchemaStep = 1, kMigrationsCutShort = 24;
#endif

TEST_F(TroubleTest, ALibraryOfEverySchemaIsCopiedAndMigrated) {
  make();
  const Schema newest = library_schema();
  Library now = open_library(folder_);
  const std::string case_id = list_cases(now).at(0).case_id;
  // A draft may change its laws; these every schema knows that has the columns.
  now.database().run(
      "UPDATE training_case SET sight_law = 'half_slice', touch_law = 'steady', breath_law = 'equal_holds'");
  for (int version = 1; version < newest_version(newest); version += kSchemaStep) {
    const fs::path old_folder = scratch_ / ("schema" + std::to_string(version));
    const fs::path file = old_folder / "seldinger.sqlite";
    fs::create_directories(old_folder);
    fs::copy(folder_ / "assets", old_folder / "assets");
    fs::copy(folder_ / "identities.sqlite", old_folder / "identities.sqlite");
    {
      Sqlite old(file, Sqlite::Mode::create);
      old.run("PRAGMA journal_mode = WAL");
      build(old, newest, version);
      Transaction copied(old);
      copy_common_columns(now.database(), old);
      copied.commit();
    }
    Library migrated = open_library(old_folder);
    EXPECT_EQ(migrated.database().integer("PRAGMA user_version"), newest_version(newest));
    const CaseRow row = find_case(migrated, case_id).value();
    EXPECT_EQ(row.title, "Kidney A");
    EXPECT_EQ(row.attributes.size(), 3U);
    EXPECT_EQ(list_lesions(migrated, case_id).size(), 1U);
    EXPECT_EQ(load_volume(migrated, row).value().hu, sample_volume().hu);
    Sqlite copy(file.string() + ".v" + std::to_string(version) + "-backup");
    EXPECT_EQ(schema_version(copy, newest).value(), version);
    EXPECT_EQ(copy.integer("SELECT count(*) FROM lesion"), 1);
    EXPECT_TRUE(problems_of(copy).empty());
    EXPECT_TRUE(problems_of(migrated.database()).empty());
    // Rows of before lack the columns that were added since, and change and go like any other.
    ASSERT_TRUE(set_title(migrated, case_id, "Kidney B").has_value());
    ASSERT_TRUE(remove_lesion(migrated, case_id, list_lesions(migrated, case_id).at(0).lesion_id).has_value());
    for (const base::Problem& problem : problems_of(migrated.database()))
      ADD_FAILURE() << problem.text << " from schema " << version;
  }
}

// A migration that is killed or fails leaves a library that opens, migrated or to be migrated again.
TEST_F(TroubleTest, AMigrationThatIsCutShortIsWalkedAgain) {
  make();
  const Schema newest = library_schema();
  base::Rng rng(3);
  for (int round = 0; round < kMigrationsCutShort; ++round) {
    const fs::path old_folder = scratch_ / "old";
    fs::remove_all(old_folder);
    fs::create_directories(old_folder);
    fs::copy(folder_ / "assets", old_folder / "assets");
    fs::copy(folder_ / "identities.sqlite", old_folder / "identities.sqlite");
    {
      Library now = open_library(folder_);
      Sqlite old(old_folder / "seldinger.sqlite", Sqlite::Mode::create);
      old.run("PRAGMA journal_mode = WAL");
      build(old, newest, 1);
      copy_common_columns(now.database(), old);
    }
    const faults::Kind kinds[] = {faults::Kind::kill, faults::Kind::write, faults::Kind::sync, faults::Kind::full};
    const long at = 1 + static_cast<long>(rng.uniform() * (round % 4 == 2 ? 12.0 : 60.0));
    const pid_t child = ::fork();
    if (child == 0) {
      faults::set({kinds[round % 4], at, true});
      int code = 0;
      try {
        code = Library::open(old_folder) ? 0 : 1;
      } catch (const base::Failure&) {
      } catch (...) {
        code = 2;
      }
      ::_exit(code);
    }
    int status = 0;
    ::waitpid(child, &status, 0);
    EXPECT_TRUE(WIFSIGNALED(status) || WEXITSTATUS(status) == 0) << status;
    const auto report = check_library(old_folder, true).value();
    EXPECT_TRUE(report.holds()) << report.findings.front().text << ", round " << round;
    Library migrated = open_library(old_folder);
    EXPECT_EQ(list_cases(migrated).size(), 1U) << round;
    EXPECT_EQ(migrated.database().integer("PRAGMA user_version"), newest_version(newest));
  }
}

}  // namespace
}  // namespace seldinger::casedb
