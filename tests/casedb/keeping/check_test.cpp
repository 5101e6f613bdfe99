// The check finds each thing that can be wrong with a library, and its repair takes away nothing but what is
// nobody's.
#include "casedb/keeping/check.h"
#include "casedb/people/people.h"

#include <sys/stat.h>

#include <algorithm>
#include <set>

#include "casedb/database/digests.h"
#include "casedb/database/disk.h"
#include "casedb/database/migrate.h"
#include "casedb/database/new_assets.h"
#include "casedb/database/tables.h"
#include "casedb/keeping/backup.h"
#include "casedb/keeping/bundle.h"
#include "casedb/keeping/erase.h"
#include "tests/casedb/bundle_samples.h"
#include "tests/casedb/library_samples.h"

namespace seldinger::casedb {
namespace {

namespace fs = std::filesystem;

class CheckTest : public testing::Test {
 protected:
  fs::path scratch_ = fresh_folder(), folder_ = scratch_ / "library", backup_ = scratch_ / "backup";
  std::string attempt_id_, volume_sha256_;

  void SetUp() override {
    Library library = open_library(folder_);
    const std::string case_id = add_case(library, sample_case());
    const std::string lesion_id = add_lesion(library, case_id, sample_lesion()).value();
    attempt_id_ = add_attempt(library, sample_attempt(case_id, lesion_id)).value();
    static_cast<void>(add_user(library, "ann", Role::trainee, "a password").value());
    volume_sha256_ = find_case(library, case_id).value().volume_sha256;
  }
  // What is not kept by the schema's own triggers. Its digests are those of the rows then, as if it were stored so.
  void change(const char* file, const std::string& sql) {
    Sqlite database(folder_ / file);
    database.run("PRAGMA foreign_keys = OFF; " + sql);
    Transaction transaction(database);
    renew_digests(database, {});
    transaction.commit();
  }
  // As a disk does, or somebody with another program.
  void change_unseen(const char* file, const std::string& sql) {
    Sqlite database(folder_ / file);
    database.run("PRAGMA foreign_keys = OFF; " + sql);
  }
  void damage_asset() {
    std::string bytes = fixtures::whole_file(folder_ / "assets" / volume_sha256_);
    bytes[bytes.size() / 2] = static_cast<char>(bytes[bytes.size() / 2] ^ 1);
    std::ofstream(folder_ / "assets" / volume_sha256_, std::ios::binary) << bytes;
  }
  void back_it_up() {
    Library library = open_library(folder_);
    ASSERT_TRUE(back_up(library, backup_, "0.1.0").has_value());
  }
  std::multiset<std::string> codes(const std::vector<base::Problem>& problems) {
    std::multiset<std::string> found;
    for (const base::Problem& problem : problems) found.insert(problem.code);
    return found;
  }
  std::multiset<std::string> found(bool repair = false) {
    return codes(check_library(folder_, repair).value().findings);
  }
  using Codes = std::multiset<std::string>;
};

TEST_F(CheckTest, AWholeLibraryHoldsAndIsNotTouched) {
  const auto before = contents_of(folder_);
  for (const bool repair : {false, true}) {
    const CheckReport report = check_library(folder_, repair).value();
    EXPECT_TRUE(report.holds());
    EXPECT_TRUE(report.repaired.empty());
    EXPECT_EQ(report.cases, 1U);
    EXPECT_EQ(report.attempts, 1U);
    EXPECT_EQ(report.assets, 4U);  // volume, skin, classes, picture
  }
  EXPECT_EQ(contents_of(folder_), before);
}

// Before, roles and owners that were changed by SQL left "all holds", and nothing had been kept that could tell.
TEST_F(CheckTest, AnAuditLogThatWasTouchedIsTold) {
  const char* open = "DROP TRIGGER audit_is_immutable; DROP TRIGGER audit_is_kept; ";
  const std::string good = fixtures::whole_file(folder_ / "seldinger.sqlite");
  const std::pair<const char*, const char*> faults[] = {
      {"UPDATE audit SET act = 'log_in' WHERE sequence = 2", "audit_changed"},
      {"DELETE FROM audit WHERE sequence = 2", "audit_missing"},
      {"UPDATE audit SET sequence = 99 WHERE sequence = 1; UPDATE audit SET sequence = 1 WHERE sequence = 2; "
       "UPDATE audit SET sequence = 2 WHERE sequence = 99",
       "audit_changed"},
      {"DELETE FROM audit WHERE sequence = (SELECT max(sequence) FROM audit)", "audit_cut"}};
  for (const auto& [sql, code] : faults) {
    EXPECT_EQ(found(), Codes{});
    change("seldinger.sqlite", std::string(open) + sql);
    EXPECT_TRUE(found().contains(code)) << sql;
    for (const char* side : {"-wal", "-shm"}) fs::remove(folder_ / (std::string("seldinger.sqlite") + side));
    std::ofstream(folder_ / "seldinger.sqlite", std::ios::binary) << good;
  }
}

TEST_F(CheckTest, WhatIsNoLibraryIsRefused) {
  EXPECT_EQ(check_library(folder_ / "nowhere", false).error().code, "no_library");
  change_unseen("seldinger.sqlite", "PRAGMA user_version = 9999");
  EXPECT_EQ(check_library(folder_, true).error().code, "newer_schema");
}

TEST_F(CheckTest, ADamagedPageIsAFindingAndNothingIsRepaired) {
  std::ofstream(folder_ / "assets" / std::string(64, 'a')) << "nobody's";
  const std::string good = fixtures::whole_file(folder_ / "seldinger.sqlite");
  std::string bad = good;
  bad.replace(good.size() - 4096, 64, std::string(64, '\x77'));
  std::ofstream(folder_ / "seldinger.sqlite", std::ios::binary) << bad;
  const auto before = contents_of(folder_ / "assets");
  EXPECT_TRUE(found(true).contains("database_damaged"));
  EXPECT_EQ(contents_of(folder_ / "assets"), before);
}

TEST_F(CheckTest, ABrokenReferenceIsFound) {
  change("seldinger.sqlite", "INSERT INTO case_warning VALUES ('" + std::string(36, 'x') + "', 0, 'a', 'b')");
  EXPECT_EQ(found(), Codes{"reference_broken"});
}

TEST_F(CheckTest, AMissingAndADamagedFileAreFoundAndStay) {
  std::string bytes = fixtures::whole_file(folder_ / "assets" / volume_sha256_);
  bytes[bytes.size() / 2] = static_cast<char>(bytes[bytes.size() / 2] ^ 1);
  std::ofstream(folder_ / "assets" / volume_sha256_, std::ios::binary) << bytes;
  EXPECT_EQ(found(true), Codes{"asset_damaged"});
  EXPECT_EQ(fixtures::whole_file(folder_ / "assets" / volume_sha256_), bytes);
  fs::remove(folder_ / "assets" / volume_sha256_);
  EXPECT_EQ(found(true), Codes{"asset_missing"});
}

TEST_F(CheckTest, AnOrphanIsFoundAndRepaired) {
  std::ofstream(folder_ / "assets" / std::string(64, 'a')) << "nobody's";
  EXPECT_EQ(found(), Codes{"asset_orphaned"});
  const CheckReport report = check_library(folder_, true).value();
  EXPECT_TRUE(report.holds());
  EXPECT_EQ(codes(report.repaired), Codes{"asset_orphaned"});
  EXPECT_FALSE(fs::exists(folder_ / "assets" / std::string(64, 'a')));
  EXPECT_EQ(found(), Codes{});
}

// Repair while another process is about to add a case: it stores its file again, and the case is whole.
TEST_F(CheckTest, RepairDoesNoHarmToAnImportUnderWay) {
  Library other = open_library(folder_);
  NewAssets assets(other);
  const std::vector<std::byte> bytes(1000, std::byte{7});
  const std::string sha256 = assets.add(bytes);
  EXPECT_EQ(codes(check_library(folder_, true).value().repaired), Codes{"asset_orphaned"});
  EXPECT_FALSE(other.has_asset(sha256));
  {
    Transaction transaction(other.database());
    assets.make_sure();
    transaction.commit();
  }
  EXPECT_TRUE(other.has_asset(sha256));
}

TEST_F(CheckTest, ALostPieceOfARecordingIsFound) {
  change("seldinger.sqlite",
         "DROP TRIGGER recording_chunk_is_kept; DELETE FROM recording_chunk WHERE sequence = 1");
  EXPECT_EQ(found(), Codes{"incomplete"});
  change("seldinger.sqlite", "DELETE FROM recording_chunk");
  EXPECT_EQ(found(), Codes{"incomplete"});
}

TEST_F(CheckTest, AChangedRecordingIsFound) {
  change("seldinger.sqlite",
         "DROP TRIGGER recording_chunk_is_immutable; "
         "UPDATE recording_chunk SET data = x'00' WHERE sequence = 2");
  EXPECT_EQ(found(), Codes{"recording_damaged"});
}

TEST_F(CheckTest, AnOpenAttemptIsLookedAtToo) {
  {
    Library library = open_library(folder_);
    const AttemptRow done = find_attempt(library, attempt_id_).value();
    const std::string open_id = open_attempt(library, done).value();
    const auto chunks = cases::chunks_from_recording(sample_recording(5000));
    for (std::size_t i = 0; i < 2; ++i) ASSERT_TRUE(add_chunk(library, open_id, chunks[i]).has_value());
  }
  EXPECT_EQ(found(), Codes{});
  change("seldinger.sqlite", "UPDATE open_chunk SET data = x'00' WHERE sequence = 1");
  EXPECT_EQ(found(), Codes{"recording_damaged"});
  change("seldinger.sqlite", "DELETE FROM open_chunk WHERE sequence = 0");
  EXPECT_EQ(found(), (Codes{"incomplete", "recording_damaged"}));
}

TEST_F(CheckTest, ALeftoverOfAKilledWriterIsFoundAndRepaired) {
  const std::string name = std::string(64, 'b') + ".tmp-4711-3";
  std::ofstream(folder_ / "assets" / name) << "half";
  std::ofstream(folder_ / "seldinger.sqlite.v3-backup.tmp-4711") << "half";
  std::ofstream(folder_ / "seldinger.sqlite.v3-backup") << "a copy that stays";
  EXPECT_EQ(found(), (Codes{"leftover_file", "leftover_file"}));
  EXPECT_EQ(codes(check_library(folder_, true).value().repaired), (Codes{"leftover_file", "leftover_file"}));
  EXPECT_FALSE(fs::exists(folder_ / "assets" / name));
  EXPECT_FALSE(fs::exists(folder_ / "seldinger.sqlite.v3-backup.tmp-4711"));
  EXPECT_TRUE(fs::exists(folder_ / "seldinger.sqlite.v3-backup"));
  EXPECT_EQ(found(), Codes{});
}

TEST_F(CheckTest, ATemporaryFileThatIsBeingWrittenIsLeftAlone) {
  NewFile writing(folder_ / "assets" / std::string(64, 'c'));
  EXPECT_EQ(found(true), Codes{});
  writing.write({});
  writing.keep();  // its name was not taken away from under it
  EXPECT_TRUE(fs::exists(folder_ / "assets" / std::string(64, 'c')));
}

TEST_F(CheckTest, WhatIsNotTheLibrarysIsToldAndLeft) {
  std::ofstream(folder_ / "assets" / "Jane Doe.txt") << "text";
  const CheckReport report = check_library(folder_, true).value();
  EXPECT_EQ(codes(report.findings), Codes{"unknown_file"});
  EXPECT_EQ(report.findings.front().text.find("Jane"), std::string::npos);
  EXPECT_TRUE(fs::exists(folder_ / "assets" / "Jane Doe.txt"));
}

TEST_F(CheckTest, ANameWithoutAPersonIsFoundAndNotTold) {
  change("identities.sqlite", "INSERT INTO identity VALUES ('" + std::string(36, '9') + "', 'Jane Doe', 1)");
  const CheckReport report = check_library(folder_, true).value();
  EXPECT_EQ(codes(report.findings), Codes{"name_without_person"});
  EXPECT_EQ(report.findings.front().text.find("Jane"), std::string::npos);
}

// Was: "all holds", and the page showed the other number.
TEST_F(CheckTest, AChangedValueIsToldWithItsAttempt) {
  change_unseen(
      "seldinger.sqlite",
      "DROP TRIGGER metric_value_is_immutable; UPDATE metric_value SET value = 4.322 WHERE value = 4.321");
  const CheckReport report = check_library(folder_, false).value();
  EXPECT_EQ(codes(report.findings), (Codes{"value_damaged", "value_damaged"}));  // and the trigger
  EXPECT_EQ(report.findings.front().text, "a value of attempt " + attempt_id_ + " is not what was stored");
}

// Was: an account's role or an attempt's owner changed by SQL, and "all holds".
TEST_F(CheckTest, ARowChangedPastTheProgramIsTold) {
  change_unseen("seldinger.sqlite", "UPDATE account SET role = 'admin'");
  EXPECT_EQ(found(), Codes{"value_damaged"});
  change_unseen("seldinger.sqlite", "UPDATE account SET role = 'trainee'");
  EXPECT_EQ(found(), Codes{});
  change_unseen("identities.sqlite", "UPDATE identity SET name = 'Jane Doe'");
  const CheckReport report = check_library(folder_, false).value();
  EXPECT_EQ(codes(report.findings), Codes{"value_damaged"});
  EXPECT_EQ(report.findings.front().text.find("Jane"), std::string::npos);
}

TEST_F(CheckTest, WhatTheProgramChangesHolds) {
  {
    Library library = open_library(folder_);
    ASSERT_TRUE(set_level(library, "ann", Level::consultant).has_value());
    ASSERT_TRUE(set_enabled(library, "ann", false).has_value());
    ASSERT_TRUE(add_metrics(library, attempt_id_, {{"time_total", 2, 4.0, "s", ""}, {"whole", 1, -3.0, "mm", ""}})
                    .has_value());
    static_cast<void>(open_attempt(library, find_attempt(library, attempt_id_).value()).value());
  }
  EXPECT_EQ(found(), Codes{});
  {
    Library library = open_library(folder_);
    ASSERT_TRUE(erase_attempt(library, attempt_id_, std::nullopt).has_value());
    ASSERT_TRUE(erase_person(library, "ann", std::nullopt).has_value());
    EXPECT_EQ(library.database().integer("SELECT count(*) FROM digest WHERE of_id GLOB '" + attempt_id_ + "*'"), 0);
  }
  EXPECT_EQ(found(), Codes{});
}

// A damaged attempt can be erased, and nothing is said of it afterwards.
TEST_F(CheckTest, ADamagedAttemptCanBeErased) {
  change_unseen("seldinger.sqlite", "DROP TRIGGER metric_value_is_immutable; UPDATE metric_value SET unit = 'x'");
  {
    Library library = open_library(folder_);
    ASSERT_TRUE(erase_attempt(library, attempt_id_, std::nullopt).has_value());
  }
  EXPECT_EQ(found(), Codes{"value_damaged"});  // the trigger
}

// A library of a schema before digests has none: what it holds when it is migrated is taken as it is.
TEST_F(CheckTest, ALibraryOfAnOlderSchemaGetsItsDigests) {
  const fs::path old_folder = scratch_ / "old";
  fs::create_directories(old_folder);
  fs::copy(folder_ / "assets", old_folder / "assets");
  for (const auto& [file, schema] :
       {std::pair("seldinger.sqlite", library_schema()), {"identities.sqlite", identities_schema()}}) {
    const auto first =
        std::ranges::find_if(schema.steps, [](const auto& step) { return step.name.ends_with("_digests.sql"); });
    Sqlite old(old_folder / file, Sqlite::Mode::create);
    old.run("PRAGMA journal_mode = WAL");
    build(old, schema, static_cast<int>(first - schema.steps.begin()));
    const Sqlite::Unguarded rows_as_they_are(old);
    old.run("ATTACH '" + (folder_ / file).string() + "' AS now");
    for (const std::string& table : tables_of(old)) {
      std::string columns;
      for (const std::string& column : columns_of(old, table)) columns += (columns.empty() ? "" : ", ") + column;
      old.run("INSERT OR REPLACE INTO main." + table + " (" + columns + ") SELECT " + columns + " FROM now." +
              table);
    }
  }
  const CheckReport migrated = check_library(old_folder, false).value();
  EXPECT_TRUE(migrated.holds()) << (migrated.holds() ? "" : migrated.findings.front().text);
  EXPECT_EQ(migrated.attempts, 1U);
  {
    Sqlite database(old_folder / "seldinger.sqlite");
    database.run("DROP TRIGGER metric_value_is_immutable; UPDATE metric_value SET unit = 'x' WHERE version = 2");
  }
  EXPECT_EQ(codes(check_library(old_folder, false).value().findings), (Codes{"value_damaged", "value_damaged"}));
}

// Was: the import said success, and the new case could not be used.
TEST_F(CheckTest, ImportingTheSameSourceHealsADamagedFile) {
  damage_asset();
  ASSERT_EQ(found(), Codes{"asset_damaged"});
  {
    Library library = open_library(folder_);
    const std::string again = add_case(library, sample_case("Again"));
    EXPECT_EQ(load_volume(library, find_case(library, again).value()).value().hu, sample_volume().hu);
  }
  EXPECT_EQ(found(), Codes{});
}

// Was: "is here already; nothing was done".
TEST_F(CheckTest, ImportingItsBundleHealsADamagedFile) {
  {
    Library library = open_library(folder_);
    ASSERT_TRUE(write_bundle(library, {}, scratch_ / "all.sdbundle", "0.1.0").has_value());
  }
  damage_asset();
  {
    Library library = open_library(folder_);
    const Unbundled done = import_bundle(library, scratch_ / "all.sdbundle").value();
    EXPECT_EQ(done.present.size(), 1U);
    EXPECT_EQ(done.healed, 1U);
  }
  EXPECT_EQ(found(), Codes{});
}

TEST_F(CheckTest, WhatIsHurtComesBackFromABackup) {
  back_it_up();
  damage_asset();
  change_unseen("seldinger.sqlite", "UPDATE account SET role = 'admin'");
  ASSERT_EQ(found(true), (Codes{"asset_damaged", "value_damaged"}));
  const CheckReport report = check_library(folder_, true, backup_).value();
  EXPECT_TRUE(report.holds());
  EXPECT_EQ(codes(report.healed), (Codes{"asset_damaged", "value_damaged"}));
  EXPECT_EQ(found(), Codes{});
}

// What came after the backup stays; what the backup has hurt itself is not taken.
TEST_F(CheckTest, NothingIsTakenFromABackupThatIsHurtItselfOrOlder) {
  back_it_up();
  {
    Library library = open_library(folder_);
    ASSERT_TRUE(set_level(library, "ann", Level::consultant).has_value());
  }
  change_unseen("seldinger.sqlite", "UPDATE account SET role = 'admin'");
  {
    Sqlite backup(backup_ / "seldinger.sqlite");
    backup.run("UPDATE account SET role = 'director'");
  }
  std::ofstream(backup_ / "assets" / volume_sha256_, std::ios::binary) << "something else";
  damage_asset();
  EXPECT_EQ(codes(check_library(folder_, true, backup_).value().findings),
            (Codes{"asset_damaged", "value_damaged"}));
  EXPECT_EQ(check_library(folder_, true, scratch_ / "nowhere").error().code, "no_backup");
  Library library = open_library(folder_);
  EXPECT_EQ(library.database().integer("SELECT count(*) FROM person_level"), 1);
}

// Was: a folder ended the check with exit 4 and no name; a FIFO was waited for, for ever.
TEST_F(CheckTest, WhatIsNoFileInAFilesPlaceIsToldAndNotOpened) {
  const fs::path place = folder_ / "assets" / volume_sha256_;
  const fs::path elsewhere = scratch_ / "elsewhere";
  fs::rename(place, elsewhere);
  for (const char* what : {"folder", "FIFO", "link", "dangling"}) {
    const std::string kind(what);
    if (kind == "folder") fs::create_directory(place);
    if (kind == "FIFO" && ::mkfifo(place.c_str(), 0600) != 0) FAIL() << "no FIFO";
    if (kind == "link") fs::create_symlink(elsewhere, place);
    if (kind == "dangling") fs::create_symlink(scratch_ / "nowhere", place);
    const CheckReport report = check_library(folder_, false).value();
    EXPECT_EQ(codes(report.findings), Codes{"asset_damaged"}) << what;
    EXPECT_NE(report.findings.front().text.find(volume_sha256_), std::string::npos) << what;
    EXPECT_EQ(report.assets, 4U) << what << ": the rest was looked at";
    {
      Library library = open_library(folder_);
      EXPECT_EQ(library.load_asset(volume_sha256_).error().code, "asset_damaged") << what;
      EXPECT_EQ(back_up(library, backup_, "0.1.0").error().code, "asset_damaged") << what;
      add_case(library, sample_case(kind));  // puts the file back
    }
    EXPECT_EQ(found(), Codes{}) << what;
    EXPECT_TRUE(fs::is_regular_file(fs::symlink_status(place))) << what;
    fs::remove(place);
  }
}
}  // namespace
}  // namespace seldinger::casedb
