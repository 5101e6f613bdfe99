// A bit turned over on the disk, anywhere in what a library stores: `check` tells it, or everything that is stored
// reads as before (free space). 50 of each kind; SELDINGER_FAULTS sets another number (the label `long` runs
// 1,000).
#include <algorithm>
#include <bit>
#include <cstdlib>
#include <set>

#include "casedb/database/disk.h"
#include "casedb/database/tables.h"
#include "casedb/keeping/backup.h"
#include "casedb/keeping/check.h"
#include "casedb/people/people.h"
#include "sim/base/rng.h"
#include "tests/casedb/library_samples.h"

namespace seldinger::casedb {
namespace {

namespace fs = std::filesystem;

int flips() {
  const char* text = std::getenv("SELDINGER_FAULTS");
  return text == nullptr ? 25 : std::atoi(text);
}

// All that a database's tables hold, by table and in the order of their rows' content.
std::multiset<std::string> all_values(const fs::path& file) {
  std::multiset<std::string> all;
  Sqlite database(file, Sqlite::Mode::immutable);
  for (const std::string& table : tables_of(database)) {
    std::string columns;
    for (const std::string& column : columns_of(database, table))
      columns += (columns.empty() ? "" : " || '|' || ") + ("quote(" + column + ")");
    for (Statement rows = database.prepare("SELECT " + columns + " AS all_of_it FROM " + table); rows.step();)
      all.insert(table + ": " + rows.text("all_of_it"));
  }
  return all;
}

class BitFlipsTest : public testing::TestWithParam<const char*> {
 protected:
  fs::path scratch_ = fresh_folder(), folder_ = scratch_ / "library";
  std::string attempt_id_;

  void SetUp() override {
    Library library = open_library(folder_);
    const std::string case_id = add_case(library, sample_case());
    const std::string lesion_id = add_lesion(library, case_id, sample_lesion()).value();
    for (int i = 0; i < 3; ++i) {
      NewAttempt attempt = sample_attempt(case_id, lesion_id);
      attempt.recording = sample_recording(2500, static_cast<std::uint64_t>(i));
      for (int metric = 0; metric < 40; ++metric)
        attempt.metrics.push_back({"metric_" + std::to_string(metric), 1, 1.0 / (metric + 2.0), "mm", ""});
      attempt_id_ = add_attempt(library, attempt).value();
    }
    static_cast<void>(add_user(library, "ann", Role::mentor, "a long password").value());
    ASSERT_TRUE(set_level(library, "ann", Level::consultant).has_value());
    static_cast<void>(open_attempt(library, find_attempt(library, attempt_id_).value()).value());
  }
  // Turns the bit over and back, and looks between.
  template <typename Function>
  void with_flipped(const fs::path& file, std::size_t bit, const Function& look) {
    std::string bytes = fixtures::whole_file(file);
    bytes[bit / 8] = static_cast<char>(static_cast<unsigned char>(bytes[bit / 8]) ^ (1U << (bit % 8)));
    std::ofstream(file, std::ios::binary) << bytes;
    look();
    bytes[bit / 8] = static_cast<char>(static_cast<unsigned char>(bytes[bit / 8]) ^ (1U << (bit % 8)));
    std::ofstream(file, std::ios::binary) << bytes;
    for (const char* side : {"-wal", "-shm"}) fs::remove(file.string() + side);
  }
  // What check says; the code of a refusal counts as being told.
  std::string told() {
    try {
      const auto report = check_library(folder_, false);
      if (!report) return report.error().code;
      return report->holds() ? "" : report->findings.front().code;
    } catch (const base::Failure& failure) {
      return failure.code();
    }
  }
};

TEST_P(BitFlipsTest, EveryFlipOfADatabaseIsToldOrChangesNoValue) {
  const fs::path file = folder_ / GetParam();
  const auto before = all_values(file);
  ASSERT_EQ(told(), "");
  base::Rng rng(11);
  int said = 0;
  const auto bits = static_cast<double>(fs::file_size(file)) * 8.0;
  const std::string good = fixtures::whole_file(file);
  for (int i = 0; i < flips(); ++i) {
    auto bit = static_cast<std::size_t>(rng.uniform() * bits);
    while (i % 4 != 0 && good[bit / 8] == 0)
      bit = static_cast<std::size_t>(rng.uniform() * bits);  // free space is 0
    with_flipped(file, bit, [&] {
      const std::string code = told();
      if (!code.empty()) {
        ++said;
        return;
      }
      EXPECT_EQ(all_values(file), before) << "bit " << bit << " of " << GetParam() << " is not told";
    });
    std::ofstream(file, std::ios::binary) << good;  // a check of a library that seems older migrates it
    for (const auto& entry : fs::directory_iterator(folder_))
      if (entry.path().filename().string().find("-backup") != std::string::npos) fs::remove(entry.path());
  }
  EXPECT_GT(said, flips() / 2) << "too few bits held something";
}

// Was: under another name the table of the digests was not found, and nothing that they would tell was told.
TEST_P(BitFlipsTest, TheNameOfTheDigestsTableIsToldToo) {
  const fs::path file = folder_ / GetParam();
  const std::string name = "tabledigestdigest";  // type, name and table of the schema's row
  const std::size_t at = fixtures::whole_file(file).find(name);
  ASSERT_NE(at, std::string::npos);
  for (std::size_t byte = at; byte < at + name.size(); ++byte)
    for (const std::size_t bit : {0U, 5U})  // another letter, and the same one large
      with_flipped(file, byte * 8 + bit, [&] { EXPECT_NE(told(), "") << byte - at << " bit " << bit; });
  EXPECT_EQ(told(), "");
}

INSTANTIATE_TEST_SUITE_P(Files, BitFlipsTest, testing::Values("seldinger.sqlite", "identities.sqlite"),
                         [](const auto& file) { return std::string(file.param).substr(0, 9); });

class ValueFlipsTest : public BitFlipsTest {};

// Was: "all holds", and the attempt shows 2.086 mm for 2.211.
TEST_F(ValueFlipsTest, AFlippedMetricIsToldWithItsAttempt) {
  const fs::path file = folder_ / "seldinger.sqlite";
  const std::string good = fixtures::whole_file(file);
  const double value = 1.0 / 9.0;  // of metric_7, in three attempts
  std::string stored(8, '\0');
  const auto bits = std::bit_cast<std::uint64_t>(value);
  for (int i = 0; i < 8; ++i) stored[static_cast<std::size_t>(i)] = static_cast<char>(bits >> (56 - 8 * i));
  std::vector<std::size_t> places;
  for (std::size_t at = good.find(stored); at != std::string::npos; at = good.find(stored, at + 1))
    places.push_back(at);
  ASSERT_EQ(places.size(), 3U);
  base::Rng rng(12);
  for (int i = 0; i < flips(); ++i) {
    // Not the exponent's highest bits: an infinity or a NaN breaks the column's own rule.
    const std::size_t bit =
        places[static_cast<std::size_t>(i) % 3] * 8 + 16 + static_cast<std::size_t>(rng.uniform() * 48);
    with_flipped(file, bit, [&] {
      const CheckReport report = check_library(folder_, false).value();
      ASSERT_EQ(report.findings.size(), 1U) << bit;
      EXPECT_EQ(report.findings.front().code, "value_damaged");
      EXPECT_NE(report.findings.front().text.find("a value of attempt 0"), std::string::npos)
          << report.findings.front().text;
      Library library = open_library(folder_);
      EXPECT_EQ(back_up(library, scratch_ / "backup", "0.1.0").error().code, "damaged");
    });
  }
  ASSERT_EQ(told(), "");
}

TEST_F(ValueFlipsTest, EveryFlipOfAPictureOrVolumeIsTold) {
  std::vector<fs::path> assets;
  for (const auto& entry : fs::directory_iterator(folder_ / "assets")) assets.push_back(entry.path());
  std::sort(assets.begin(), assets.end());
  ASSERT_EQ(assets.size(), 4U);
  base::Rng rng(13);
  for (int i = 0; i < flips(); ++i) {
    const fs::path& file = assets[static_cast<std::size_t>(i) % assets.size()];
    const auto bit = static_cast<std::size_t>(rng.uniform() * static_cast<double>(fs::file_size(file)) * 8.0);
    with_flipped(file, bit, [&] { EXPECT_EQ(told(), "asset_damaged") << bit; });
  }
  ASSERT_EQ(told(), "");
}

// Was: check told it, backup and restore said "all checked".
TEST_F(ValueFlipsTest, EveryFlipOfARecordingIsToldAndNotBackedUp) {
  const fs::path file = folder_ / "seldinger.sqlite";
  const std::string good = fixtures::whole_file(file);
  std::string piece;
  {
    Library library = open_library(folder_);
    Statement row = library.database().prepare("SELECT data FROM recording_chunk WHERE attempt_id = :id");
    ASSERT_TRUE(row.bind("id", attempt_id_).step());
    const std::vector<std::byte> bytes = row.bytes("data");
    // Of the last bytes: they lie in one piece on their page.
    piece.assign(reinterpret_cast<const char*>(bytes.data() + bytes.size() - 400), 400);
  }
  const std::size_t place = good.find(piece);
  ASSERT_NE(place, std::string::npos);
  base::Rng rng(14);
  for (int i = 0; i < flips(); ++i) {
    const std::size_t bit = place * 8 + static_cast<std::size_t>(rng.uniform() * 3200);
    with_flipped(file, bit, [&] {
      const CheckReport report = check_library(folder_, false).value();
      ASSERT_EQ(report.findings.size(), 1U) << bit;
      EXPECT_EQ(report.findings.front().code, "recording_damaged");
      EXPECT_NE(report.findings.front().text.find(attempt_id_), std::string::npos);
      Library library = open_library(folder_);
      const auto copied = back_up(library, scratch_ / "backup", "0.1.0");
      ASSERT_FALSE(copied.has_value()) << bit;
      EXPECT_EQ(copied.error().code, "damaged");
      EXPECT_NE(copied.error().text.find(attempt_id_), std::string::npos);
      EXPECT_FALSE(fs::exists(scratch_ / "backup"));
    });
  }
  ASSERT_EQ(told(), "");
}

// Each flip of a value, a recording or a file comes back from the backup, to the bit.
TEST_F(ValueFlipsTest, WhatIsTurnedOverComesBackFromABackup) {
  {
    Library library = open_library(folder_);
    ASSERT_TRUE(back_up(library, scratch_ / "backup", "0.1.0").has_value());
  }
  const fs::path file = folder_ / "seldinger.sqlite";
  const auto before = all_values(file);
  const std::string good = fixtures::whole_file(file);
  base::Rng rng(15);
  int healed = 0;
  for (int i = 0; i < flips(); ++i) {
    std::string bytes = good;
    const auto bit = static_cast<std::size_t>(rng.uniform() * static_cast<double>(good.size()) * 8.0);
    bytes[bit / 8] = static_cast<char>(static_cast<unsigned char>(bytes[bit / 8]) ^ (1U << (bit % 8)));
    std::ofstream(file, std::ios::binary) << bytes;
    try {
      const auto report = check_library(folder_, true, scratch_ / "backup");
      if (report && report->holds()) {
        healed += !report->healed.empty();
        EXPECT_EQ(all_values(file), before) << "bit " << bit;
      }
    } catch (const base::Failure&) {  // a page of SQLite's own: the whole library is to be restored
    }
    std::ofstream(file, std::ios::binary) << good;
    for (const auto& entry : fs::directory_iterator(folder_))
      if (const std::string name = entry.path().filename().string();
          name.find("-backup") != std::string::npos || name.ends_with("-wal") || name.ends_with("-shm"))
        fs::remove(entry.path());
  }
  EXPECT_GT(healed, flips() / 4);
}

}  // namespace
}  // namespace seldinger::casedb
