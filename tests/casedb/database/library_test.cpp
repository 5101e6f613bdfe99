// A library on disk: it appears whole or not at all, what is not one is refused untouched, assets are what they
// say.
#include "casedb/database/library.h"
#include "casedb/people/people.h"

#include <sqlite3.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "casedb/database/credentials.h"
#include "casedb/database/sqlite.h"
#include "tests/casedb/library_samples.h"

namespace seldinger::casedb {
namespace {

namespace fs = std::filesystem;

class LibraryTest : public testing::Test {
 protected:
  fs::path folder_ = fresh_folder();
  fs::path library_ = folder_ / "library";

  std::string refusal_to_open() {
    const auto library = Library::open(library_);
    return library ? "none" : library.error().code;
  }
  std::string refusal_to_create() {
    const auto library = Library::open_or_create(library_);
    return library ? "none" : library.error().code;
  }
  void make() { open_library(library_); }
};

TEST_F(LibraryTest, IsMadeWithItsParents) {
  library_ = folder_ / "a" / "b" / "library";
  make();
  const auto contents = contents_of(library_);
  ASSERT_EQ(contents.size(), 3U);
  EXPECT_EQ(contents.count("seldinger.sqlite"), 1U);
  EXPECT_EQ(contents.count("identities.sqlite"), 1U);
  EXPECT_EQ(contents.count("assets"), 1U);
  EXPECT_EQ(refusal_to_open(), "none");
  EXPECT_EQ(refusal_to_create(), "none");
}

TEST_F(LibraryTest, IsMadeInAnEmptyFolder) {
  fs::create_directory(library_);
  EXPECT_EQ(refusal_to_open(), "no_library");
  EXPECT_TRUE(fs::is_empty(library_));
  EXPECT_EQ(refusal_to_create(), "none");
  EXPECT_EQ(refusal_to_open(), "none");
}

TEST_F(LibraryTest, NamesAreReadableByTheirOwnerOnly) {
  const mode_t mask = ::umask(0);
  auto library = open_library(library_);
  static_cast<void>(add_user(library, "ann", Role::trainee, "a password").value());
  ::umask(mask);
  struct stat about {};
  for (const char* file : {"identities.sqlite", "identities.sqlite-wal", "identities.sqlite-shm"}) {
    ASSERT_EQ(::stat((library_ / file).c_str(), &about), 0) << file;
    EXPECT_EQ(about.st_mode & 0777U, 0600U) << file;
  }
}

// Was: folders 0777 and the database 0660 less the umask, so that with none everybody could write them.
TEST_F(LibraryTest, AllOfItIsItsOwnersAloneWhateverTheUmask) {
  const mode_t mask = ::umask(0);
  {
    auto library = open_library(library_ / "");
    add_case(library, sample_case());
  }
  ::umask(mask);
  const auto expect_private = [&] {
    for (const auto& entry : fs::recursive_directory_iterator(library_)) {
      struct stat about {};
      ASSERT_EQ(::stat(entry.path().c_str(), &about), 0);
      EXPECT_EQ(about.st_mode & 0777U, entry.is_directory() ? 0700U : 0600U) << entry.path().filename();
    }
    EXPECT_EQ(fs::status(library_).permissions(), fs::perms::owner_all);
  };
  expect_private();
  // One of before, at its next opening.
  fs::permissions(library_, fs::perms(0755));
  fs::permissions(library_ / "assets", fs::perms(0755));
  fs::permissions(library_ / "seldinger.sqlite", fs::perms(0640));
  EXPECT_EQ(refusal_to_open(), "none");
  expect_private();
}

// Was: a link planted under the temporary name was followed, and what it led to overwritten.
TEST_F(LibraryTest, APlantedTemporaryNameIsNotFollowed) {
  const fs::path victim = folder_ / "victim";
  std::ofstream(victim) << "theirs";
  make();
  auto library = open_library(library_);
  const std::vector<std::byte> abc{std::byte{'a'}, std::byte{'b'}, std::byte{'c'}};
  const std::string name = sha256_hex(abc);
  for (int number = 0; number < 80; ++number)
    fs::create_symlink(
        victim, library_ / "assets" / (name + ".tmp-" + std::to_string(::getpid()) + "-" + std::to_string(number)));
  EXPECT_EQ(library.store_asset(abc).sha256, name);
  EXPECT_EQ(fixtures::whole_file(victim), "theirs");
  EXPECT_EQ(library.load_asset(name).value(), abc);
}

// Was: `duplicate column name: subject`.
TEST_F(LibraryTest, ASchemaVersionThatWasSetBackIsToldAndNothingIsChanged) {
  make();
  const auto newest = Sqlite(library_ / "seldinger.sqlite").integer("PRAGMA user_version");
  { Sqlite(library_ / "seldinger.sqlite").run("PRAGMA user_version = 10"); }
  const auto before = contents_of(library_);
  const auto library = Library::open(library_);
  ASSERT_FALSE(library.has_value());
  EXPECT_EQ(library.error().code, "schema_mismatch");
  EXPECT_NE(library.error().text.find("0011_subject"), std::string::npos) << library.error().text;
  EXPECT_NE(library.error().text.find("user_version to " + std::to_string(newest)), std::string::npos);
  EXPECT_EQ(contents_of(library_), before);
  { Sqlite(library_ / "seldinger.sqlite").run("PRAGMA user_version = " + std::to_string(newest)); }
  EXPECT_EQ(refusal_to_open(), "none");
}

TEST_F(LibraryTest, WhatIsNoFileInADatabasesPlaceIsRefusedAndNotOpened) {
  for (const char* name : {"seldinger.sqlite", "identities.sqlite", "seldinger.sqlite-wal"}) {
    fs::remove_all(library_);
    make();
    const fs::path place = library_ / name;
    fs::remove(place);
    ASSERT_EQ(::mkfifo(place.c_str(), 0600), 0);
    EXPECT_EQ(refusal_to_open(), "damaged") << name;
    fs::remove(place);
    fs::create_symlink(folder_ / "elsewhere", place);
    EXPECT_EQ(refusal_to_open(), "damaged") << name;
    fs::remove(place);
  }
}

TEST_F(LibraryTest, GivesBackThePagesItKeeps) {
  Library library = open_library(library_);
  library.database().run(
      "CREATE TABLE filler AS WITH RECURSIVE n(i) AS (SELECT 1 UNION ALL SELECT i + 1 FROM n LIMIT 400) "
      "SELECT i, zeroblob(4000) AS bytes FROM n");
  ASSERT_EQ(library.database().integer("SELECT count(*) FROM filler WHERE length(bytes) = 4000"), 400);
  const auto before = sqlite3_memory_used();
  library.shrink();
  EXPECT_LT(sqlite3_memory_used(), before - (1 << 20)) << "of 1.6 MB that were written and read";
  EXPECT_EQ(library.database().integer("SELECT count(*) FROM filler"), 400) << "and goes on";
}

TEST_F(LibraryTest, AMissingFolderIsNoLibraryAndIsNotMade) {
  EXPECT_EQ(refusal_to_open(), "no_library");
  EXPECT_FALSE(fs::exists(library_));
}

TEST_F(LibraryTest, AFileIsNoLibrary) {
  std::ofstream(library_) << "text";
  EXPECT_EQ(refusal_to_open(), "no_library");
  EXPECT_EQ(refusal_to_create(), "not_a_library");
  EXPECT_EQ(fixtures::whole_file(library_), "text");
}

TEST_F(LibraryTest, AFolderOfSomethingElseIsRefusedUntouched) {
  for (const char* name : {"letter.txt", ".hidden", "identities.sqlite", "assets/x", "seldinger.sqlite-wal"}) {
    fs::remove_all(library_);
    fs::create_directories((library_ / name).parent_path());
    std::ofstream(library_ / name) << "text";
    const auto before = contents_of(library_);
    EXPECT_EQ(refusal_to_create(), "not_a_library") << name;
    EXPECT_EQ(refusal_to_open(), "no_library") << name;
    EXPECT_EQ(contents_of(library_), before) << name;
  }
}

TEST_F(LibraryTest, WhatAKilledCreationLeavesIsNoHindrance) {
  for (const std::vector<std::string>& left :
       {std::vector<std::string>{"seldinger.sqlite.new"},
        {"seldinger.sqlite.new", "seldinger.sqlite.new-wal", "seldinger.sqlite.new-shm"},
        {"seldinger.sqlite.new", "identities.sqlite.new", "identities.sqlite.new-journal"},
        {"seldinger.sqlite.new", "identities.sqlite"}}) {
    fs::remove_all(library_);
    fs::create_directories(library_ / "assets");
    for (const auto& name : left) std::ofstream(library_ / name) << "half";
    EXPECT_EQ(refusal_to_open(), "no_library") << left.back();
    EXPECT_EQ(refusal_to_create(), "none") << left.back();
    EXPECT_EQ(contents_of(library_).size(), 3U) << left.back();
  }
}

TEST_F(LibraryTest, AnEmptyOrForeignDatabaseIsNoLibraryOfOurs) {
  make();
  const std::string ours = fixtures::whole_file(library_ / "seldinger.sqlite");
  const std::string names = fixtures::whole_file(library_ / "identities.sqlite");
  for (const std::string& content : {std::string(), std::string(10000, 'x'), names}) {
    std::ofstream(library_ / "seldinger.sqlite", std::ios::binary) << content;
    const auto before = contents_of(library_);
    EXPECT_EQ(refusal_to_open(), "not_a_library");
    EXPECT_EQ(refusal_to_create(), "not_a_library");
    EXPECT_EQ(contents_of(library_), before);
  }
  std::ofstream(library_ / "seldinger.sqlite", std::ios::binary) << ours;
  EXPECT_EQ(refusal_to_open(), "none");
}

TEST_F(LibraryTest, ANewerSchemaIsRefusedUntouched) {
  make();
  { Sqlite(library_ / "seldinger.sqlite").run("PRAGMA user_version = 9999"); }
  const auto before = contents_of(library_);
  EXPECT_EQ(refusal_to_open(), "newer_schema");
  EXPECT_EQ(refusal_to_create(), "newer_schema");
  EXPECT_EQ(contents_of(library_), before);
}

TEST_F(LibraryTest, DamageIsRefused) {
  make();
  const std::string good = fixtures::whole_file(library_ / "seldinger.sqlite");
  for (std::size_t page = 0; page < good.size() / 4096; ++page) {
    std::string bad = good;
    const std::size_t from = page * 4096 + (page == 0 ? 100 : 0);  // behind the file's header
    bad.replace(from, 64, std::string(64, '\x77'));
    std::ofstream(library_ / "seldinger.sqlite", std::ios::binary) << bad;
    EXPECT_EQ(refusal_to_open(), "damaged") << "page " << page;
  }
  std::ofstream(library_ / "seldinger.sqlite", std::ios::binary) << good.substr(0, good.size() / 2);
  EXPECT_EQ(refusal_to_open(), "damaged");
  std::ofstream(library_ / "seldinger.sqlite", std::ios::binary) << good;
  EXPECT_EQ(refusal_to_open(), "none");
}

TEST_F(LibraryTest, WithoutItsNamesItIsDamaged) {
  make();
  fs::remove(library_ / "identities.sqlite");
  EXPECT_EQ(refusal_to_open(), "damaged");
  EXPECT_EQ(refusal_to_create(), "damaged");
  EXPECT_FALSE(fs::exists(library_ / "identities.sqlite"));
}

TEST_F(LibraryTest, RefusalsNameNoPath) {
  fs::create_directories(library_);
  std::ofstream(library_ / "Jane Doe.txt") << "text";
  for (const auto& library : {Library::open(library_), Library::open_or_create(library_)}) {
    EXPECT_EQ(library.error().text.find("Jane"), std::string::npos);
    EXPECT_EQ(library.error().text.find(library_.filename().string() + "/"), std::string::npos);
  }
}

TEST_F(LibraryTest, ProcessesThatMakeTheSameOneAtOnceAllSucceed) {
  for (int round = 0; round < 5; ++round) {
    fs::remove_all(folder_ / "race");
    library_ = folder_ / "race" / "parent" / "library";
    int gate[2];
    ASSERT_EQ(::pipe(gate), 0);
    std::vector<pid_t> children;
    for (int i = 0; i < 6; ++i) {
      const pid_t child = ::fork();
      ASSERT_GE(child, 0);
      if (child == 0) {
        char byte;
        ::close(gate[1]);
        if (::read(gate[0], &byte, 1) != 0) ::_exit(1);  // all start when the parent closes its end
        int code = 1;
        try {
          auto library = Library::open_or_create(library_);
          if (library && !add_case(*library, sample_case()).empty()) code = 0;
        } catch (const std::exception&) {
          code = 2;
        }
        ::_exit(code);
      }
      children.push_back(child);
    }
    ::close(gate[0]);
    ::close(gate[1]);
    for (const pid_t child : children) {
      int status = -1;
      ::waitpid(child, &status, 0);
      EXPECT_EQ(status, 0);
    }
    auto library = open_library(library_);
    EXPECT_EQ(list_cases(library).size(), 6U);
    EXPECT_EQ(library.database().text("PRAGMA integrity_check"), "ok");
  }
}

// --- assets
// -------------------------------------------------------------------------------------------------------
std::vector<std::byte> some_bytes(std::size_t count) {
  std::vector<std::byte> bytes(count);
  for (std::size_t i = 0; i < count; ++i) bytes[i] = static_cast<std::byte>(i * 7 % 251);
  return bytes;
}

TEST_F(LibraryTest, AnAssetIsNamedByItsSha256) {
  auto library = open_library(library_);
  const std::vector<std::byte> abc{std::byte{'a'}, std::byte{'b'}, std::byte{'c'}};
  const auto stored = library.store_asset(abc);
  EXPECT_TRUE(stored.created);
  EXPECT_EQ(stored.sha256, "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");  // FIPS 180-2, B.1
  EXPECT_EQ(fixtures::whole_file(library_ / "assets" / stored.sha256), "abc");
  EXPECT_EQ(library.load_asset(stored.sha256).value(), abc);
  EXPECT_EQ(std::distance(fs::directory_iterator(library_ / "assets"), {}), 1);  // no temporary file
}

TEST_F(LibraryTest, AnAssetIsStoredOnce) {
  auto library = open_library(library_);
  EXPECT_TRUE(library.store_asset(some_bytes(1000)).created);
  EXPECT_FALSE(library.store_asset(some_bytes(1000)).created);
  const auto empty = library.store_asset({});
  EXPECT_TRUE(empty.created);
  EXPECT_EQ(library.load_asset(empty.sha256).value().size(), 0U);
}

TEST_F(LibraryTest, ATruncatedAssetIsReplacedButNotTakenBack) {
  auto library = open_library(library_);
  const auto stored = library.store_asset(some_bytes(1000));
  fs::resize_file(library_ / "assets" / stored.sha256, 10);
  EXPECT_FALSE(library.store_asset(some_bytes(1000)).created);
  EXPECT_EQ(library.load_asset(stored.sha256).value(), some_bytes(1000));
}

// Was: the damaged bytes stayed, and storing said success.
TEST_F(LibraryTest, ADamagedAssetOfTheRightSizeIsReplaced) {
  auto library = open_library(library_);
  const auto stored = library.store_asset(some_bytes(1000));
  std::string bytes = fixtures::whole_file(library_ / "assets" / stored.sha256);
  bytes[500] = static_cast<char>(bytes[500] ^ 1);
  std::ofstream(library_ / "assets" / stored.sha256, std::ios::binary) << bytes;
  EXPECT_FALSE(library.store_asset(some_bytes(1000)).created);
  EXPECT_EQ(library.load_asset(stored.sha256).value(), some_bytes(1000));
}

TEST_F(LibraryTest, AMissingOrDamagedAssetIsRefused) {
  auto library = open_library(library_);
  const auto stored = library.store_asset(some_bytes(1000));
  std::string bytes = fixtures::whole_file(library_ / "assets" / stored.sha256);
  bytes[500] = static_cast<char>(bytes[500] ^ 1);
  std::ofstream(library_ / "assets" / stored.sha256, std::ios::binary) << bytes;
  EXPECT_EQ(library.load_asset(stored.sha256).error().code, "asset_damaged");
  library.remove_asset(stored.sha256);
  EXPECT_EQ(library.load_asset(stored.sha256).error().code, "asset_missing");
  EXPECT_FALSE(fs::exists(library_ / "assets" / stored.sha256));
}

TEST_F(LibraryTest, AnAssetsNameLeadsNowhereElse) {
  auto library = open_library(library_);
  for (const char* name : {"", ".", "../seldinger.sqlite", "/etc/passwd"}) {
    EXPECT_EQ(library.load_asset(name).error().code, "asset_missing") << name;
    library.remove_asset(name);
  }
  EXPECT_TRUE(fs::exists(library_ / "seldinger.sqlite"));
  EXPECT_TRUE(fs::exists(library_ / "assets"));
}

}  // namespace
}  // namespace seldinger::casedb
