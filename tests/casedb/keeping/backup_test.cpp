// A backup of a library in use comes back as it was, and nothing else does.
#include "casedb/keeping/backup.h"
#include "casedb/people/people.h"

#include <sys/stat.h>

#include <algorithm>
#include <atomic>
#include <thread>

#include "casedb/database/credentials.h"
#include "casedb/database/disk.h"
#include "casedb/keeping/check.h"
#include "casedb/people/password_links.h"
#include "tests/casedb/library_samples.h"
#include "tests/fixtures/allocations.h"

namespace seldinger::casedb {
namespace {

namespace fs = std::filesystem;

class BackupTest : public testing::Test {
 protected:
  fs::path scratch_ = fresh_folder();
  fs::path folder_ = scratch_ / "library", backup_ = scratch_ / "backup", restored_ = scratch_ / "restored";

  void make() {
    Library library = open_library(folder_);
    const std::string case_id = add_case(library, sample_case());
    const std::string lesion_id = add_lesion(library, case_id, sample_lesion()).value();
    static_cast<void>(add_attempt(library, sample_attempt(case_id, lesion_id)).value());
    static_cast<void>(add_user(library, "ann", Role::mentor, "a password").value());
  }
  std::string backed_up() {
    Library library = open_library(folder_);
    const auto copied = back_up(library, backup_, "0.1.0");
    return copied ? "none" : copied.error().code;
  }
  std::string refusal() {
    const auto copied = restore(backup_, restored_);
    return copied ? "none" : copied.error().code;
  }
};

// Was: both databases whole in memory, only to be hashed: 450 MB of 413 MB.
TEST_F(BackupTest, TakesNoMoreMemoryForALargeDatabase) {
  make();
  {
    Sqlite database(folder_ / "seldinger.sqlite");
    database.run(
        "CREATE TABLE large (bytes BLOB); INSERT INTO large VALUES (zeroblob(64000000)); DROP TABLE large");
  }
  Library library = open_library(folder_);
  const std::size_t before = fixtures::live_bytes();
  fixtures::forget_peak();
  ASSERT_TRUE(back_up(library, backup_, "0.1.0").has_value());
  EXPECT_GT(fs::file_size(backup_ / "seldinger.sqlite"), 64'000'000U);
  EXPECT_LT(fixtures::peak_bytes() - before, std::size_t{16} << 20);
}

TEST_F(BackupTest, ComesBackAsItWas) {
  make();
  ASSERT_EQ(backed_up(), "none");
  fs::remove_all(folder_);
  const auto kept = contents_of(backup_);
  ASSERT_EQ(refusal(), "none");
  EXPECT_EQ(contents_of(backup_), kept);
  EXPECT_EQ(contents_of(scratch_).count("backup.unfinished"), 0U);
  EXPECT_EQ(contents_of(scratch_).count("restored.unfinished"), 0U);
  Library library = open_library(restored_);
  EXPECT_TRUE(check_library(restored_, false).value().holds());
  const CaseRow row = list_cases(library).front();
  EXPECT_EQ(row.title, "Kidney A");
  EXPECT_EQ(load_volume(library, row).value().hu, sample_volume().hu);
  const AttemptRow attempt = list_attempts(library).front();
  EXPECT_EQ(difference(load_recording(library, attempt.attempt_id).value(), sample_recording()), "");
  ASSERT_TRUE(log_in(library, "ann", "a password").has_value());
  // It is a library like any other.
  static_cast<void>(add_lesion(library, row.case_id, sample_lesion()).value());
}

// Whoever comes upon an old link sets nobody's password in a library that came back from before it was used.
TEST_F(BackupTest, NoLinkToSetAPasswordComesBack) {
  make();
  std::string secret;
  {
    Library library = open_library(folder_);
    secret = make_password_link(library, "ann").value().secret;
  }
  ASSERT_EQ(backed_up(), "none");
  ASSERT_EQ(refusal(), "none");
  Library library = open_library(folder_), restored = open_library(restored_);
  EXPECT_TRUE(account_of_password_link(library, secret).has_value());
  EXPECT_FALSE(account_of_password_link(restored, secret).has_value());
  EXPECT_EQ(restored.database().integer("SELECT count(*) FROM password_link"), 0);
}

TEST_F(BackupTest, IsReadableByItsOwnerOnly) {
  make();
  const mode_t mask = ::umask(0);
  ASSERT_EQ(backed_up(), "none");
  ASSERT_EQ(refusal(), "none");
  ::umask(mask);
  struct stat about {};
  ASSERT_EQ(::stat(backup_.c_str(), &about), 0);
  EXPECT_EQ(about.st_mode & 0777U, 0700U);
  // Was: the restored one 0750, its database 0640.
  for (const fs::path& folder : {backup_, restored_})
    for (const auto& entry : fs::recursive_directory_iterator(folder)) {
      ASSERT_EQ(::stat(entry.path().c_str(), &about), 0);
      EXPECT_EQ(about.st_mode & 0777U, entry.is_directory() ? 0700U : 0600U) << entry.path();
    }
  ASSERT_EQ(::stat(restored_.c_str(), &about), 0);
  EXPECT_EQ(about.st_mode & 0777U, 0700U);
}

TEST_F(BackupTest, NothingIsOverwritten) {
  make();
  fs::create_directory(backup_);
  EXPECT_EQ(backed_up(), "exists");
  EXPECT_TRUE(fs::is_empty(backup_));
  fs::remove(backup_);
  ASSERT_EQ(backed_up(), "none");
  fs::create_directory(restored_);
  std::ofstream(restored_ / "letter") << "text";
  EXPECT_EQ(refusal(), "exists");
  EXPECT_EQ(contents_of(restored_).size(), 1U);
  fs::remove_all(restored_);
  std::ofstream(restored_) << "text";
  EXPECT_EQ(refusal(), "exists");
  EXPECT_EQ(fixtures::whole_file(restored_), "text");
  fs::remove(restored_);
  fs::create_directory(restored_);  // empty
  EXPECT_EQ(refusal(), "none");
  EXPECT_EQ(refusal(), "exists");
}

// Cases and accounts come while backups are made: each is one whole state, and at least what was there before.
TEST_F(BackupTest, OfALibraryInUseIsOneState) {
  make();
  std::atomic<bool> stop{false};
  std::atomic<int> added{0};
  std::thread writer([&] {
    Library library = open_library(folder_);
    for (std::uint64_t number = 10; !stop; ++number) {
      NewCase sample = sample_case("Case " + std::to_string(number));
      sample.volume = sample_volume({9, 7, 5}, number);
      const std::string case_id = add_case(library, sample);
      const std::string lesion_id = add_lesion(library, case_id, sample_lesion()).value();
      static_cast<void>(add_attempt(library, sample_attempt(case_id, lesion_id)).value());
      ++added;
    }
  });
  Library library = open_library(folder_);
  for (int round = 0; round < 4; ++round) {
    const int before = added;
    const fs::path out = scratch_ / ("backup" + std::to_string(round)),
                   in = scratch_ / ("in" + std::to_string(round));
    const auto copied = back_up(library, out, "0.1.0");
    ASSERT_TRUE(copied.has_value()) << copied.error().code;
    ASSERT_TRUE(restore(out, in).has_value());
    const CheckReport report = check_library(in, false).value();
    EXPECT_TRUE(report.holds()) << (report.holds() ? "" : report.findings.front().text);
    EXPECT_GE(report.cases, static_cast<std::size_t>(before + 1));
    while (added == before) std::this_thread::yield();
  }
  stop = true;
  writer.join();
}

TEST_F(BackupTest, OfADamagedLibraryIsRefusedAndLeavesNothing) {
  make();
  const fs::path asset = fs::directory_iterator(folder_ / "assets")->path();
  const std::string good = fixtures::whole_file(asset);
  std::ofstream(asset, std::ios::binary) << good << 'x';
  EXPECT_EQ(backed_up(), "asset_damaged");
  fs::remove(asset);
  EXPECT_EQ(backed_up(), "asset_missing");
  EXPECT_EQ(std::distance(fs::directory_iterator(scratch_), {}), 1);
}

// Was: "all checked", and the restored library failed its check.
TEST_F(BackupTest, OfALibraryWithAHurtRecordingOrValueIsRefusedAndNamesIt) {
  make();
  const auto hurt = [&](const fs::path& file, const std::string& sql) {
    Sqlite database(file);
    database.run(sql);
  };
  const std::string good = fixtures::whole_file(folder_ / "seldinger.sqlite");
  for (const auto& [table, code] :
       {std::pair("recording_chunk", "recording_damaged"), {"metric_value", "value_damaged"}}) {
    const std::string name = table;
    hurt(folder_ / "seldinger.sqlite", "DROP TRIGGER " + name + "_is_immutable; UPDATE " + name +
                                           (name == "metric_value" ? " SET value = 2 WHERE value = 4.321"
                                                                   : " SET data = x'00' WHERE sequence = 1"));
    Library library = open_library(folder_);
    const auto copied = back_up(library, backup_, "0.1.0");
    ASSERT_FALSE(copied.has_value());
    EXPECT_EQ(copied.error().code, "damaged");
    EXPECT_TRUE(std::ranges::any_of(copied.error().findings, [&](const auto& one) { return one.code == code; }));
    EXPECT_FALSE(fs::exists(backup_));
    std::ofstream(folder_ / "seldinger.sqlite", std::ios::binary) << good;
  }
}

// A backup made before backups looked at recordings: restore does.
TEST_F(BackupTest, ABackupWithAHurtRecordingIsNotRestored) {
  make();
  ASSERT_EQ(backed_up(), "none");
  const fs::path file = backup_ / "seldinger.sqlite";
  {
    Sqlite database(file);
    database.run(
        "DROP TRIGGER recording_chunk_is_immutable; UPDATE recording_chunk SET data = x'00' WHERE sequence = 1");
  }
  std::string list = fixtures::whole_file(backup_ / "backup.txt");
  const std::string bytes = fixtures::whole_file(file);
  const std::size_t at = list.find("file seldinger.sqlite ");
  list.replace(
      at, list.find('\n', at) - at,
      "file seldinger.sqlite " + std::to_string(bytes.size()) + " " + sha256_hex(std::as_bytes(std::span(bytes))));
  std::ofstream(backup_ / "backup.txt") << list;
  EXPECT_EQ(refusal(), "damaged");
  EXPECT_FALSE(fs::exists(restored_));
}

TEST_F(BackupTest, AnyChangedByteIsRefusedAndNothingIsThere) {
  make();
  ASSERT_EQ(backed_up(), "none");
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(backup_))
    if (entry.is_regular_file()) files.push_back(entry.path());
  ASSERT_EQ(files.size(), 7U);
  base::Rng rng(5);
  for (const fs::path& file : files) {
    const std::string good = fixtures::whole_file(file);
    for (int kind = 0; kind < 4; ++kind) {
      std::string bad = good;
      const auto at = static_cast<std::size_t>(rng.uniform() * static_cast<double>(good.size()));
      if (kind == 0) bad[at] = static_cast<char>(bad[at] ^ 4);
      if (kind == 1) bad.resize(at);
      if (kind == 2) bad += "x";
      std::ofstream(file, std::ios::binary) << bad;
      if (kind == 3) fs::remove(file);
      const std::string code = refusal();
      // Only the program's version in the list says nothing that could be held against anything.
      if (file.filename() == "backup.txt" && code == "none" && kind == 0) {
        fs::remove_all(restored_);
      } else {
        EXPECT_TRUE(code == "damaged" || code == "no_backup") << file.filename() << " " << kind << " " << code;
      }
      EXPECT_FALSE(fs::exists(restored_));
      std::ofstream(file, std::ios::binary) << good;
    }
  }
  EXPECT_FALSE(fs::exists(scratch_ / "restored.unfinished"));
  EXPECT_EQ(refusal(), "none");
}

TEST_F(BackupTest, AListThatLeadsElsewhereIsRefused) {
  make();
  ASSERT_EQ(backed_up(), "none");
  const std::string good = fixtures::whole_file(backup_ / "backup.txt");
  const std::string end = "end 6\n", hash(64, 'a');
  ASSERT_TRUE(good.ends_with(end));
  for (const std::string& name : {std::string("../x"), std::string("/etc/passwd"), std::string("assets/../../x"),
                                  std::string("assets/") + hash + "/x", std::string("seldinger.sqlite-wal")}) {
    std::ofstream(backup_ / "backup.txt")
        << good.substr(0, good.size() - end.size()) << "file " + name + " 1 " + hash + "\nend 7\n";
    EXPECT_EQ(refusal(), "damaged") << name;
    EXPECT_FALSE(fs::exists(restored_));
  }
}

TEST_F(BackupTest, WhatIsNoBackupIsRefused) {
  EXPECT_EQ(refusal(), "no_backup");
  fs::create_directory(backup_);
  EXPECT_EQ(refusal(), "no_backup");
  make();
  fs::remove_all(backup_);
  fs::copy(folder_, backup_, fs::copy_options::recursive);  // a library is none
  EXPECT_EQ(refusal(), "no_backup");
}

TEST_F(BackupTest, OfANewerSchemaIsRefused) {
  make();
  ASSERT_EQ(backed_up(), "none");
  const fs::path file = backup_ / "seldinger.sqlite";
  { Sqlite(file).run("PRAGMA user_version = 9999"); }
  std::string list = fixtures::whole_file(backup_ / "backup.txt");
  const std::string bytes = fixtures::whole_file(file);
  const std::size_t at = list.find("file seldinger.sqlite ");
  list.replace(
      at, list.find('\n', at) - at,
      "file seldinger.sqlite " + std::to_string(bytes.size()) + " " + sha256_hex(std::as_bytes(std::span(bytes))));
  std::ofstream(backup_ / "backup.txt") << list;
  EXPECT_EQ(refusal(), "newer_schema");
  EXPECT_FALSE(fs::exists(restored_));
}

TEST_F(BackupTest, LeftByAKilledProcessIsReplaced) {
  make();
  fs::create_directory(scratch_ / "backup.unfinished");
  std::ofstream(scratch_ / "backup.unfinished" / "seldinger.sqlite") << "half";
  EXPECT_EQ(backed_up(), "none");
  EXPECT_FALSE(fs::exists(scratch_ / "backup.unfinished"));
  EXPECT_EQ(refusal(), "none");
}

// Yesterday's, which was killed, stayed for ever, with names in it: today's has another name. What is being
// written, what holds something else, what is empty and what a link leads to is left alone.
TEST_F(BackupTest, TheNextBackupTakesWhatAKilledOneLeft) {
  make();
  const auto left = [&](const char* name, std::initializer_list<const char*> files) {
    const fs::path folder = scratch_ / name;
    fs::create_directories(folder / "assets");
    for (const char* file : files) std::ofstream(folder / file) << "half";
    return folder;
  };
  const std::string asset = "assets/" + std::string(64, 'a');
  const fs::path killed = left("2026-01-01.unfinished", {"seldinger.sqlite", "identities.sqlite", asset.c_str(),
                                                         (asset + ".tmp-4194305-3").c_str(), "backup.txt.tmp-1-1"}),
                 foreign = left("essay.unfinished", {"seldinger.sqlite", "chapter1.txt"}),
                 other = left("2026-01-02", {"seldinger.sqlite"}),
                 linked = left("real.unfinished", {"seldinger.sqlite"});
  fs::create_symlink(other / "seldinger.sqlite", linked / "identities.sqlite");
  fs::create_directory(scratch_ / "empty.unfinished");
  fs::create_directory_symlink(other, scratch_ / "link.unfinished");
  NewFolder running(scratch_ / "running");
  std::ofstream(running.unfinished() / "seldinger.sqlite") << "half";
  EXPECT_EQ(backed_up(), "none");
  EXPECT_FALSE(fs::exists(killed));
  for (const fs::path& path :
       {foreign, other, linked, scratch_ / "empty.unfinished", scratch_ / "link.unfinished", running.unfinished()})
    EXPECT_TRUE(fs::exists(path)) << path;
  EXPECT_EQ(fixtures::whole_file(foreign / "chapter1.txt"), "half");
}

}  // namespace
}  // namespace seldinger::casedb
