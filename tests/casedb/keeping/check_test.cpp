// The check finds each thing that can be wrong with a library, and its repair takes away nothing but what is
// nobody's.
#include "casedb/keeping/check.h"
#include "casedb/people/people.h"

#include <set>

#include "casedb/database/disk.h"
#include "casedb/database/new_assets.h"
#include "tests/casedb/library_samples.h"

namespace seldinger::casedb {
namespace {

namespace fs = std::filesystem;

class CheckTest : public testing::Test {
 protected:
  fs::path folder_ = fresh_folder() / "library";
  std::string attempt_id_, volume_sha256_;

  void SetUp() override {
    Library library = open_library(folder_);
    const std::string case_id = add_case(library, sample_case());
    const std::string lesion_id = add_lesion(library, case_id, sample_lesion()).value();
    attempt_id_ = add_attempt(library, sample_attempt(case_id, lesion_id)).value();
    static_cast<void>(add_user(library, "ann", Role::trainee, "password").value());
    volume_sha256_ = find_case(library, case_id).value().volume_sha256;
  }
  // What is not kept by the schema's own triggers.
  void change(const char* file, const std::string& sql) {
    Sqlite database(folder_ / file);
    database.run("PRAGMA foreign_keys = OFF; " + sql);
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
  change("seldinger.sqlite", "PRAGMA user_version = 9999");
  EXPECT_EQ(check_library(folder_, true).error().code, "newer_schema");
}

TEST_F(CheckTest, ADamagedPageIsAFindingAndNothingIsRepaired) {
  std::ofstream(folder_ / "assets" / std::string(64, 'a')) << "nobody's";
  const std::string good = fixtures::whole_file(folder_ / "seldinger.sqlite");
  std::string bad = good;
  bad.replace(good.size() - 4096, 64, std::string(64, '\x77'));
  std::ofstream(folder_ / "seldinger.sqlite", std::ios::binary) << bad;
  const auto before = contents_of(folder_ / "assets");
  EXPECT_EQ(found(true), Codes{"database_damaged"});
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

}  // namespace
}  // namespace seldinger::casedb
