// Erasing: what went is nowhere in the library's folder, nor in what is backed up later; what others did stays, and
// the library's check is clean. Files are searched byte by byte for what was planted.
#include "casedb/keeping/erase.h"

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <fstream>

#include "casedb/cases/authoring.h"
#include "casedb/cases/versions.h"
#include "casedb/database/sqlite.h"
#include "casedb/database/tables.h"
#include "casedb/keeping/backup.h"
#include "casedb/keeping/check.h"
#include "casedb/people/cohorts.h"
#include "casedb/people/consent.h"
#include "casedb/people/facts.h"
#include "casedb/people/people.h"
#include "tests/casedb/library_samples.h"

namespace seldinger::casedb {
namespace {

constexpr const char* kName = "Zebedee Quagmire";
constexpr double kValue = 7.234567890123456e-3;  // as a metric; no other number has its 8 bytes
constexpr const char* kNote = "Zebedee found the vein by luck";

std::string code(const base::Result<Erased>& result) {
  return result ? "none" : result.error().code;
}

// As SQLite stores a double: big-endian.
std::string stored(double value) {
  std::string bytes(8, '\0');
  std::memcpy(bytes.data(), &value, 8);
  std::reverse(bytes.begin(), bytes.end());
  return bytes;
}

class EraseTest : public testing::Test {
 protected:
  std::filesystem::path folder_ = fresh_folder();
  std::optional<Library> library_ = open_library(folder_ / "library");
  std::string case_id_ = add_case(*library_, sample_case());
  std::string lesion_id_ = add_lesion(*library_, case_id_, sample_lesion()).value();
  std::string zebedee_ = add_user(*library_, kName, Role::mentor, "a password").value();
  std::string tim_ = add_user(*library_, "Tim", Role::trainee, "a password").value();

  NewAttempt attempt_by(const std::string& person_id, std::uint64_t seed, double value) const {
    NewAttempt made = sample_attempt(case_id_, lesion_id_);
    made.person_id = person_id;
    made.operator_name = kPersonOperator;
    made.recording = sample_recording(4321, seed);
    made.picture_png = {std::byte{0x89}, std::byte{'P'}, std::byte(seed)};
    made.metrics.push_back({"vis_joint", 1, value, "share", ""});
    return made;
  }
  // What must not be found afterwards: the name, its lower case, the values, pieces of every recorded chunk, ids.
  std::vector<std::pair<std::string, std::string>> planted(const std::string& attempt_id) {
    std::vector<std::pair<std::string, std::string>> all = {
        {"name", kName}, {"note", kNote}, {"value", stored(kValue)}, {"attempt", attempt_id}};
    Statement chunks = library_->database().prepare("SELECT data FROM recording_chunk WHERE attempt_id = :id");
    for (chunks.bind("id", attempt_id); chunks.step();) {
      const std::vector<std::byte> bytes = chunks.bytes("data");
      for (std::size_t at = 64; at + 24 <= bytes.size(); at += std::max<std::size_t>(bytes.size() / 16, 64))
        all.emplace_back("recording at " + std::to_string(at),
                         std::string(reinterpret_cast<const char*>(bytes.data()) + at, 24));
    }
    return all;
  }
  // How many files hold it, by what was planted. The library is closed meanwhile.
  static std::map<std::string, int> found_in(const std::filesystem::path& folder,
                                             const std::vector<std::pair<std::string, std::string>>& planted) {
    std::map<std::string, int> found;
    for (const auto& [name, bytes] : contents_of(folder))
      for (const auto& [what, secret] : planted)
        if (bytes.find(secret) != bytes.npos) ++found[what];
    return found;
  }
  void reopen() {
    library_.reset();
    library_.emplace(open_library(folder_ / "library"));
  }
};

TEST_F(EraseTest, NothingOfAPersonIsLeftInAnyFile) {
  const std::string attempt_id = add_attempt(*library_, attempt_by(zebedee_, 11, kValue)).value();
  const std::string kept = add_attempt(*library_, attempt_by(tim_, 12, 0.5)).value();
  ASSERT_TRUE(submit_case(*library_, case_id_, kName, kNote));
  const std::string cohort = add_cohort(*library_, "2026 autumn", "Radiology", "").value();
  ASSERT_TRUE(enrol(*library_, cohort, zebedee_, Post::mentor));
  ASSERT_TRUE(give_fact(*library_, zebedee_, "years_in_radiology", "13.5"));
  ASSERT_EQ(add_consent_text(*library_, std::nullopt, "May your attempts be used?").value(), 1);
  ASSERT_TRUE(give_consent(*library_, zebedee_, list_consents(*library_, zebedee_).at(0).text_id));
  const std::filesystem::path jobs = folder_ / "library" / kJobsFolder;
  for (const std::string& whose : {zebedee_, tim_})
    std::filesystem::create_directories(jobs / whose / "a job" / "results");
  std::ofstream(jobs / zebedee_ / "a job" / "results" / "export.csv") << kNote;
  const auto secrets = planted(attempt_id);
  ASSERT_GT(secrets.size(), 15U);
  // As a change of the schema leaves them.
  library_.reset();
  for (const char* file : {kDatabaseFile, kIdentitiesFile})
    std::filesystem::copy_file(folder_ / "library" / file, (folder_ / "library" / file).string() + ".v12-backup");
  const auto before = found_in(folder_ / "library", secrets);
  for (const auto& [what, secret] : secrets) EXPECT_GE(before.count(what), 1U) << what << " was not planted";
  library_.emplace(open_library(folder_ / "library"));
  const std::size_t assets_before = assets_named(library_->database()).size();

  // As an SQLite starts that was not built to overwrite what is deleted.
  for (Sqlite* database : {&library_->database(), &library_->identities()})
    database->run("PRAGMA secure_delete = OFF");
  const auto erased = erase_person(*library_, kName, std::nullopt);
  ASSERT_TRUE(erased) << erased.error().text;
  EXPECT_EQ(erased->attempts, 1U);
  EXPECT_EQ(erased->assets, 1U) << "the picture at the trigger";
  EXPECT_EQ(erased->old_copies, 2U);
  EXPECT_TRUE(erased->overwritten);
  EXPECT_EQ(assets_named(library_->database()).size(), assets_before - 1);
  EXPECT_FALSE(std::filesystem::exists(jobs / zebedee_));
  EXPECT_TRUE(std::filesystem::exists(jobs / tim_)) << "of somebody else nothing goes";
  ASSERT_TRUE(back_up(*library_, folder_ / "backup", "0.1.0"));
  EXPECT_EQ(code(erase_person(*library_, kName, std::nullopt)), "no_user");
  library_.reset();
  for (const char* place : {"library", "backup"})
    for (const auto& [what, files] : found_in(folder_ / place, secrets))
      ADD_FAILURE() << what << " is still in " << files << " files of the " << place;
  const auto report = check_library(folder_ / "library", false);
  ASSERT_TRUE(report);
  EXPECT_TRUE(report->holds()) << report->findings.at(0).text;

  library_.emplace(open_library(folder_ / "library"));
  Sqlite& database = library_->database();
  EXPECT_EQ(list_users(*library_).size(), 1U);
  EXPECT_TRUE(load_recording(*library_, kept)) << "what others did stays";
  EXPECT_EQ(database.integer("SELECT count(*) FROM person WHERE erased_us IS NOT NULL AND pseudonym LIKE 'E-%'"),
            1);
  EXPECT_EQ(database.integer("SELECT count(*) FROM erased_attempt JOIN erasure USING (erasure_id) WHERE "
                             "what = 'person'"),
            1);
  EXPECT_EQ(database.integer("SELECT count(*) FROM case_decision WHERE decision = 'submitted' AND note = ''"), 1);
  EXPECT_EQ(database.integer("SELECT count(*) FROM consent WHERE withdrawn_us IS NOT NULL"), 1);
  for (const char* table : {"person_fact", "enrolment", "erasing"})
    EXPECT_EQ(database.integer(std::string("SELECT count(*) FROM ") + table), 0) << table;
  EXPECT_TRUE(add_user(*library_, kName, Role::trainee, "a password")) << "the name is free again";
}

// A server and a window hold the library open for days: nothing may lie in its log until they close it. Another
// process looks, since closing a file here would drop SQLite's locks.
TEST_F(EraseTest, NothingIsLeftWhileOthersHaveTheLibraryOpen) {
  static_cast<void>(add_attempt(*library_, attempt_by(zebedee_, 19, kValue)).value());
  ASSERT_TRUE(submit_case(*library_, case_id_, kName, kNote));
  Library other = open_library(folder_ / "library");
  EXPECT_EQ(count_attempts(other), 1U);
  const auto is_found = [&] {
    const std::string folder = (folder_ / "library").string();
    return std::system(("grep -rqaF Zebedee '" + folder + "'").c_str()) == 0;
  };
  ASSERT_TRUE(is_found());
  const auto erased = erase_person(*library_, kName, std::nullopt);
  ASSERT_TRUE(erased);
  EXPECT_TRUE(erased->overwritten);
  EXPECT_FALSE(is_found());
  EXPECT_EQ(count_attempts(other), 0U);
}

// Who reads all the time holds up the overwriting, not the erasing, and that is told.
TEST_F(EraseTest, AReaderThatDoesNotEndIsTold) {
  static_cast<void>(add_attempt(*library_, attempt_by(zebedee_, 20, kValue)).value());
  Library other = open_library(folder_ / "library");
  {
    const Snapshot reading(other.database());
    EXPECT_EQ(other.database().integer("SELECT count(*) FROM attempt"), 1);
    library_->database().run("PRAGMA busy_timeout = 50");
    const auto erased = erase_person(*library_, kName, std::nullopt);
    ASSERT_TRUE(erased);
    EXPECT_FALSE(erased->overwritten);
    EXPECT_EQ(count_attempts(*library_), 0U);
  }
}

TEST_F(EraseTest, AnOpenAttemptGoesToo) {
  NewAttempt made = attempt_by(zebedee_, 13, kValue);
  const std::string open = open_attempt(*library_, made).value();
  ASSERT_EQ(list_open_attempts(*library_).size(), 1U);
  EXPECT_EQ(erase_person(*library_, kName, std::nullopt)->attempts, 1U);
  EXPECT_EQ(list_open_attempts(*library_).size(), 0U);
}

TEST_F(EraseTest, WhoWithdrawsKeepsTheAccountAndNothingElse) {
  const std::string attempt_id = add_attempt(*library_, attempt_by(zebedee_, 14, kValue)).value();
  static_cast<void>(add_attempt(*library_, attempt_by(tim_, 15, 0.5)).value());
  auto secrets = planted(attempt_id);
  std::erase_if(secrets, [](const auto& one) { return one.first == "name" || one.first == "note"; });
  EXPECT_EQ(erase_attempts_of(*library_, zebedee_, zebedee_)->attempts, 1U);
  EXPECT_EQ(list_users(*library_).size(), 2U);
  EXPECT_EQ(count_attempts(*library_), 1U);
  library_.reset();
  EXPECT_TRUE(found_in(folder_ / "library", secrets).empty());
  reopen();
  EXPECT_EQ(library_->database().integer("SELECT count(*) FROM erasure WHERE what = 'attempts' AND by_person_id "
                                         "IS NOT NULL"),
            1);
  EXPECT_EQ(code(erase_attempts_of(*library_, "nobody", std::nullopt)), "no_person");
}

TEST_F(EraseTest, OneAttemptGoesAndItsPictureWhenNobodyElseHasIt) {
  NewAttempt made = attempt_by(tim_, 16, 0.5);
  const std::string first = add_attempt(*library_, made).value(), second = add_attempt(*library_, made).value();
  EXPECT_EQ(erase_attempt(*library_, first, std::nullopt)->assets, 0U) << "the other attempt has the same picture";
  EXPECT_EQ(code(erase_attempt(*library_, first, std::nullopt)), "no_attempt");
  EXPECT_EQ(library_->database().integer("SELECT count(*) FROM erasure"), 1) << "a refusal changes nothing";
  EXPECT_EQ(erase_attempt(*library_, second, std::nullopt)->assets, 1U);
  EXPECT_EQ(count_attempts(*library_), 0U);
  library_.reset();
  EXPECT_TRUE(check_library(folder_ / "library", false)->holds());
}

TEST_F(EraseTest, ACaseGoesOnlyWithoutAttemptsAndNotWhilePublished) {
  const std::string attempt_id = add_attempt(*library_, attempt_by(tim_, 17, 0.5)).value();
  EXPECT_EQ(code(erase_case(*library_, case_id_, std::nullopt)), "has_attempts");
  ASSERT_TRUE(submit_case(*library_, case_id_, kName));
  EXPECT_EQ(code(erase_case(*library_, case_id_, std::nullopt)), "bad_state");
  ASSERT_TRUE(judge_case(*library_, case_id_, kName, false));
  ASSERT_TRUE(erase_attempt(*library_, attempt_id, std::nullopt));
  const auto erased = erase_case(*library_, case_id_, std::nullopt);
  ASSERT_TRUE(erased) << erased.error().text;
  EXPECT_GT(erased->assets, 1U);
  EXPECT_TRUE(list_cases(*library_).empty());
  EXPECT_EQ(code(erase_case(*library_, case_id_, std::nullopt)), "no_case");
  library_.reset();
  const auto report = check_library(folder_ / "library", false);
  EXPECT_TRUE(report->holds()) << report->findings.at(0).text;
  EXPECT_EQ(report->assets, 0U);
}

// Its standard refers to its lesion, and goes after it. Before: FOREIGN KEY constraint failed, for ever.
TEST_F(EraseTest, ARetiredCaseGoesWithItsStandard) {
  const std::string attempt_id = add_attempt(*library_, attempt_by(tim_, 21, 0.5)).value();
  const std::string standard_id(36, 's');
  Sqlite& database = library_->database();
  {
    Transaction written(database);
    database.run("INSERT INTO standard VALUES ('" + standard_id + "', '" + case_id_ + "', '" + lesion_id_ +
                 "', 'mpr', 'in_plane', 'core', 'set', 1, 1, 1, '" + zebedee_ + "', 1)");
    database.run("INSERT INTO standard_attempt VALUES ('" + standard_id + "', '" + attempt_id + "')");
    database.run("INSERT INTO standard_band VALUES ('" + standard_id +
                 "', 0, 'hit', 1, 'bool', 8, 0, 1, 0.5, 0.1, NULL, "
                 "NULL)");
    database.run("INSERT INTO cut VALUES ('" + std::string(36, 'c') + "', '" + case_id_ +
                 "', 'hit', 1, 1, 'hofstee', '', 'value', 0.5, NULL, NULL, 8, 'in words', '" + zebedee_ +
                 "', 1, NULL, NULL)");
    written.commit();
  }
  ASSERT_TRUE(erase_attempt(*library_, attempt_id, std::nullopt));
  {
    Transaction retired(database);
    database.run("UPDATE training_case SET state = 'published'");
    database.run("UPDATE training_case SET state = 'retired'");
    retired.commit();
  }
  const auto erased = erase_case(*library_, case_id_, std::nullopt);
  ASSERT_TRUE(erased) << erased.error().text;
  for (const char* table : {"training_case", "lesion", "standard", "standard_band", "cut"})
    EXPECT_EQ(database.integer(std::string("SELECT count(*) FROM ") + table), 0) << table;
  library_.reset();
  EXPECT_TRUE(check_library(folder_ / "library", false)->holds());
}

// Killed where the name is about to go (a trigger stands for that): all else has gone, so that asking again
// finishes it. Before, the name went first; then asking again answered no_user, and the copies lay there with all
// they held.
TEST_F(EraseTest, TheNameGoesLast) {
  static_cast<void>(add_attempt(*library_, attempt_by(zebedee_, 22, kValue)).value());
  const auto copy = folder_ / "library" / (std::string(kDatabaseFile) + ".v12-backup");
  std::filesystem::copy_file(folder_ / "library" / kDatabaseFile, copy);
  library_->identities().run(
      "CREATE TRIGGER killed BEFORE DELETE ON identity BEGIN SELECT RAISE(ABORT, 'killed'); END");
  EXPECT_THROW(static_cast<void>(erase_person(*library_, kName, std::nullopt)), DatabaseFailure);
  EXPECT_FALSE(std::filesystem::exists(copy));
  library_->identities().run("DROP TRIGGER killed");
  EXPECT_EQ(code(erase_person(*library_, kName, std::nullopt)), "none");
  EXPECT_EQ(code(erase_person(*library_, kName, std::nullopt)), "no_user");
}

// Before: silent, and the user read that nothing could be brought back. A folder of that name cannot be unlinked.
TEST_F(EraseTest, ACopyThatCannotBeDeletedIsTold) {
  static_cast<void>(add_attempt(*library_, attempt_by(tim_, 23, kValue)).value());
  std::filesystem::create_directory(folder_ / "library" / (std::string(kDatabaseFile) + ".v12-backup"));
  const auto erased = erase_attempts_of(*library_, tim_, tim_);
  ASSERT_TRUE(erased);
  EXPECT_EQ(erased->kept_copies, 1U);
  EXPECT_EQ(erased->old_copies, 0U);
}

// Before: an erasure in the log of erasures, and both databases written anew, as often as anybody asked.
TEST_F(EraseTest, WhereNothingWasRecordedNothingIsDone) {
  static_cast<void>(add_attempt(*library_, attempt_by(zebedee_, 24, kValue)).value());
  const auto changes = library_->database().integer("SELECT total_changes()");
  EXPECT_EQ(erase_attempts_of(*library_, tim_, tim_)->attempts, 0U);
  EXPECT_EQ(library_->database().integer("SELECT total_changes()"), changes);
  EXPECT_EQ(library_->database().integer("SELECT count(*) FROM erasure"), 0);
}

TEST_F(EraseTest, WhatIsDeletedIsOverwrittenAtOnce) {
  for (Sqlite* database : {&library_->database(), &library_->identities()})
    EXPECT_EQ(database->integer("PRAGMA secure_delete"), 1);
}

// What is deleted by what refers to it is found without looking at every row. Before: SCAN, thrice.
TEST_F(EraseTest, WhatRefersToAnAttemptOrACaseIsFoundByAnIndex) {
  for (const char* where :
       {"replay_watched WHERE attempt_id", "standard_attempt WHERE attempt_id", "standard WHERE case_id"}) {
    Statement plan =
        library_->database().prepare(std::string("EXPLAIN QUERY PLAN DELETE FROM ") + where + " = 'x'");
    ASSERT_TRUE(plan.step());
    EXPECT_EQ(plan.text("detail").find("SEARCH"), 0U) << where << ": " << plan.text("detail");
  }
}

// A later migration that refers to people says what becomes of its rows.
TEST_F(EraseTest, EveryReferenceToAPersonIsRemovedOrKept) {
  std::set<std::pair<std::string, std::string>> told, there;
  for (const auto& list : {removed_with_a_person(), kept_of_a_person()})
    for (const PersonColumn& one : list) EXPECT_TRUE(told.emplace(one.table, one.column).second) << one.table;
  for (const Reference& one : references_to(library_->database(), "person")) there.emplace(one.table, one.column);
  EXPECT_EQ(told, there);
}

// And one that keeps what belongs to an attempt, a case or a person lets an erasure through.
TEST_F(EraseTest, EveryTriggerAgainstDeletingLetsAnErasureThrough) {
  Sqlite& database = library_->database();
  int seen = 0;
  for (const char* parent : {"attempt", "open_attempt", "training_case"}) {
    std::set<std::string> tables = {parent};
    for (const Reference& one : references_to(database, parent)) tables.insert(one.table);
    for (const std::string& table : tables) {
      Statement rows = database.prepare(
          "SELECT name, sql FROM sqlite_schema WHERE type = 'trigger' AND tbl_name = :name AND sql LIKE '%BEFORE "
          "DELETE%'");
      for (rows.bind("name", table); rows.step(); ++seen)
        EXPECT_TRUE(rows.text("sql").find("erasing") != std::string::npos ||
                    rows.text("name") == "training_case_published_is_kept")
            << rows.text("name") << " would stop the erasing of what refers to " << parent;
    }
  }
  EXPECT_GT(seen, 7);
}

TEST_F(EraseTest, OutsideOfAnErasureNothingCanBeDeleted) {
  const std::string attempt_id = add_attempt(*library_, attempt_by(tim_, 18, 0.5)).value();
  static_cast<void>(erase_person(*library_, kName, std::nullopt));
  for (const char* table : {"attempt", "metric_value", "recording_chunk", "erasure"})
    EXPECT_TRUE(refused_by_constraint([&] { library_->database().run(std::string("DELETE FROM ") + table); }))
        << table;
  EXPECT_TRUE(load_recording(*library_, attempt_id));
}

}  // namespace
}  // namespace seldinger::casedb
