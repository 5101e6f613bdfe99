// What `check --repair` may conclude from a backup, what erasing leaves of damaged rows, and how damage that no
// backup mends is accepted.
#include "casedb/cases/authoring.h"
#include "casedb/database/audit.h"
#include "casedb/database/digests.h"
#include "casedb/database/migrate.h"
#include "casedb/database/tables.h"
#include "casedb/database/uuid.h"
#include "casedb/keeping/backup.h"
#include "casedb/keeping/check.h"
#include "casedb/keeping/erase.h"
#include "casedb/people/cohorts.h"
#include "casedb/people/consent.h"
#include "casedb/people/facts.h"
#include "casedb/people/login_session.h"
#include "casedb/people/password_links.h"
#include "casedb/people/people.h"
#include "casedb/people/web_sessions.h"
#include "tests/casedb/library_samples.h"

namespace seldinger::casedb {
namespace {

namespace fs = std::filesystem;

class DamageTest : public testing::Test {
 protected:
  fs::path scratch_ = fresh_folder(), folder_ = scratch_ / "library", backup_ = scratch_ / "backup";
  std::string case_id_, lesion_id_, zoe_, bob_;

  void SetUp() override {
    Library library = open_library(folder_);
    case_id_ = add_case(library, sample_case());
    lesion_id_ = add_lesion(library, case_id_, sample_lesion()).value();
    zoe_ = add_user(library, "zoe", Role::trainee, "a long password").value();
    bob_ = add_user(library, "bob", Role::trainee, "a long password").value();
  }
  std::string attempt_by(Library& library, const std::string& person_id) {
    NewAttempt made = sample_attempt(case_id_, lesion_id_);
    made.person_id = person_id;
    made.operator_name = kPersonOperator;
    made.metrics.push_back({"path_tip", 1, 71.5, "mm", ""});
    return add_attempt(library, made).value();
  }
  // As a disk does, or somebody with another program.
  void change_unseen(const std::string& sql, const char* file = kDatabaseFile) {
    Sqlite database(folder_ / file);
    const Sqlite::Unguarded free(database);
    database.run(sql);
  }
  void back_it_up() {
    Library library = open_library(folder_);
    ASSERT_TRUE(back_up(library, backup_, "0.1.0").has_value());
  }
  std::int64_t integer(const std::string& sql) {
    Sqlite database(folder_ / kDatabaseFile);
    return database.integer(sql);
  }
  // What the check says, in its own words.
  std::vector<std::string> found() {
    std::vector<std::string> texts;
    const CheckReport report = check_library(folder_, false).value();
    for (const base::Problem& problem : report.findings) texts.push_back(problem.code + ": " + problem.text);
    return texts;
  }
  std::vector<std::string> none_;
};

// Was: "healed", "all holds", two metrics gone for good: neither place had the rows, and the digest was deleted.
TEST_F(DamageTest, ALossIsNotHealedByAnOlderBackup) {
  back_it_up();
  std::string attempt_id;
  {
    Library library = open_library(folder_);
    attempt_id = attempt_by(library, zoe_);
  }
  ASSERT_EQ(found(), none_);
  change_unseen("DELETE FROM metric_value WHERE attempt_id = '" + attempt_id + "'");
  ASSERT_EQ(found().size(), 1U);
  const CheckReport report = check_library(folder_, true, backup_).value();
  EXPECT_TRUE(report.healed.empty());
  EXPECT_FALSE(report.holds());
  EXPECT_EQ(found().size(), 1U) << "and it stays told";
}

// Was: a role that had gone back to what it was at the backup was "healed", and with it the lost change.
TEST_F(DamageTest, ARowThatWentBackToTheBackupIsTold) {
  back_it_up();
  {
    Library library = open_library(folder_);
    ASSERT_TRUE(set_role(library, "zoe", Role::mentor).has_value());
  }
  change_unseen("UPDATE account SET role = 'trainee', epoch = 0 WHERE person_id = '" + zoe_ + "'");
  ASSERT_EQ(found().size(), 1U);
  EXPECT_TRUE(check_library(folder_, true, backup_).value().healed.empty());
  EXPECT_EQ(found().size(), 1U);
}

// A lost write can hit the digests too. Was: the new attempt's rows were deleted, as the backup has none of them.
TEST_F(DamageTest, NoRowIsTakenAwayBecauseTheBackupHasFewer) {
  back_it_up();
  {
    Library library = open_library(folder_);
    static_cast<void>(attempt_by(library, zoe_));
  }
  change_unseen("DELETE FROM digest WHERE of_table IN ('attempt', 'metric_value', 'recording_chunk')");
  const auto before =
      integer("SELECT (SELECT count(*) FROM metric_value) + (SELECT count(*) FROM recording_chunk)");
  ASSERT_GT(before, 2);
  const auto told = found();
  ASSERT_EQ(told.size(), 3U);
  EXPECT_TRUE(check_library(folder_, true, backup_).value().healed.empty());
  EXPECT_EQ(integer("SELECT (SELECT count(*) FROM metric_value) + (SELECT count(*) FROM recording_chunk)"), before);
  EXPECT_EQ(integer("SELECT count(*) FROM attempt"), 1);
  EXPECT_EQ(found(), told);
}

TEST_F(DamageTest, ABitOfTheDigestItselfComesBack) {
  back_it_up();
  change_unseen("UPDATE digest SET sum = (sum | 1024) - (sum & 1024) WHERE of_table = 'account' AND of_id = '" +
                zoe_ + "'");
  ASSERT_EQ(found().size(), 1U);
  EXPECT_EQ(check_library(folder_, true, backup_).value().healed.size(), 1U);
  EXPECT_EQ(found(), none_);
}

// Was: after `user erase zoe` `value_damaged` for ever, and every backup refused.
TEST_F(DamageTest, AnErasedPersonsDamageGoesToo) {
  {
    Library library = open_library(folder_);
    const std::string cohort = add_cohort(library, "2026 autumn", "Radiology/Spine", "").value();
    const std::string study = add_study(library, "Needles").value();
    const std::string attempt_id = attempt_by(library, bob_);
    for (const std::string& person : {zoe_, bob_}) {
      ASSERT_TRUE(enrol(library, cohort, person, Post::learner));
      ASSERT_TRUE(add_researcher(library, study, person));
      ASSERT_TRUE(appoint_director(library, "Radiology/Spine", person));
      ASSERT_TRUE(give_fact(library, person, "handedness", "left"));
      ASSERT_TRUE(note_replay_watched(library, person, attempt_id));
    }
    ASSERT_TRUE(set_level(library, "zoe", Level::consultant));
    static_cast<void>(begin_login_session(library, log_in(library, "zoe", "a long password").value()));
    ASSERT_TRUE(make_password_link(library, "zoe").has_value());
    keep_web_sessions(library, 8080, {{{std::string(64, 'a'), zoe_, "mark", 1, 2, now_us() + 1'000'000'000}}, {}});
  }
  ASSERT_EQ(found(), none_);
  const std::string of_zoe = " WHERE person_id = '" + zoe_ + "'; ";
  std::string sql;
  for (const char* change : {"enrolment SET from_us = from_us - 1", "study_researcher SET from_us = from_us - 1",
                             "programme_director SET from_us = from_us - 1", "person_fact SET answer = 'right'",
                             "replay_watched SET watched_us = watched_us - 1", "person_level SET level = 'student'",
                             "account SET role = 'admin'", "login_session SET ends_us = ends_us + 1",
                             "web_session SET ends_us = ends_us + 1", "password_link SET ends_us = ends_us + 1"})
    sql += std::string("UPDATE ") + change + of_zoe;
  change_unseen(sql);
  const auto told = found();
  ASSERT_EQ(told.size(), 10U);
  for (const std::string& text : told) EXPECT_EQ(text.find("Radiology"), std::string::npos) << text;
  {
    Library library = open_library(folder_);
    ASSERT_TRUE(erase_person(library, "zoe", std::nullopt).has_value());
  }
  EXPECT_EQ(found(), none_);
  // Bob's rows are still watched over.
  change_unseen("UPDATE enrolment SET post = 'mentor'");
  EXPECT_EQ(found(),
            std::vector<std::string>{"value_damaged: what enrolment holds of " + bob_ + " is not what was stored"});
  change_unseen("UPDATE enrolment SET post = 'learner'");
  back_it_up();
}

// Rows that a disk took before the person was erased are not missed afterwards. Was: told for ever.
TEST_F(DamageTest, WhatWasLostOfAnErasedPersonIsNotMissed) {
  {
    Library library = open_library(folder_);
    ASSERT_TRUE(give_fact(library, zoe_, "handedness", "left"));
  }
  change_unseen("DELETE FROM person_fact");
  ASSERT_EQ(found().size(), 1U);
  {
    Library library = open_library(folder_);
    ASSERT_TRUE(erase_person(library, "zoe", std::nullopt).has_value());
  }
  EXPECT_EQ(found(), none_);
}

// Was: the table empty, and the check still told of the session.
TEST_F(DamageTest, AnEndedSessionLeavesNoAlarm) {
  std::string token;
  {
    Library library = open_library(folder_);
    token = begin_login_session(library, log_in(library, "zoe", "a long password").value());
  }
  change_unseen("UPDATE login_session SET ends_us = ends_us + 1");
  ASSERT_EQ(found().size(), 1U);
  {
    Library library = open_library(folder_);
    ASSERT_TRUE(end_login_session(library, token));
  }
  EXPECT_EQ(found(), none_);
}

// Was: lesions go by ids of their own, and the alarm stayed.
TEST_F(DamageTest, ADeletedCasesDamagedLesionIsNotTold) {
  change_unseen("UPDATE lesion SET hu = hu + 1; UPDATE training_case SET title = 'B'");
  ASSERT_EQ(found().size(), 2U);
  {
    Library library = open_library(folder_);
    ASSERT_TRUE(erase_case(library, case_id_, std::nullopt).has_value());
  }
  EXPECT_EQ(found(), none_);
}

// Was: no way back: without a good copy of the row every backup was refused.
TEST_F(DamageTest, WhatNoBackupHasIsAcceptedAndNoted) {
  std::string attempt_id;
  {
    Library library = open_library(folder_);
    attempt_id = attempt_by(library, zoe_);
  }
  change_unseen("UPDATE metric_value SET value = 72.5 WHERE metric_id = 'path_tip'");
  change_unseen("UPDATE identity SET created_us = 1 WHERE name = 'zoe'", kIdentitiesFile);
  {
    Library library = open_library(folder_);
    EXPECT_EQ(back_up(library, backup_, "0.1.0").error().code, "damaged");
    CheckReport report = check_library(folder_, true).value();
    ASSERT_EQ(report.findings.size(), 2U);
    accept_damaged_values(library, report);
    EXPECT_TRUE(report.holds());
    ASSERT_EQ(report.accepted.size(), 2U);
    EXPECT_EQ(report.accepted.front().text, "a value of attempt " + attempt_id + " is kept as it is now");
    const auto log = list_audit(library);
    ASSERT_GE(log.size(), 2U);
    const AuditRow& values = log.at(log.size() - 2);
    EXPECT_EQ(values.act, "accept_damaged");
    EXPECT_EQ(values.object, "metric_value");
    EXPECT_EQ(values.object_id, attempt_id);
    EXPECT_EQ(log.back().object, "identity");
    EXPECT_EQ(log.back().object_id, zoe_);
  }
  EXPECT_EQ(found(), none_);
  back_it_up();
  EXPECT_EQ(check_library(backup_, false).value().findings.size(), 0U);
}

// Was: one digest for each of its metrics, 89 bytes each; of 20,000 attempts 235 MB.
TEST_F(DamageTest, AnAttemptHasADigestForEachTable) {
  Library library = open_library(folder_);
  const auto before = library.database().integer("SELECT count(*) FROM digest");
  NewAttempt made = sample_attempt(case_id_, lesion_id_);
  for (int i = 0; i < 100; ++i) made.metrics.push_back({"metric_" + std::to_string(i), 1, 1.5, "mm", ""});
  static_cast<void>(add_attempt(library, made).value());
  EXPECT_LE(library.database().integer("SELECT count(*) FROM digest") - before, 10);
}

// Takes away what later schemas brought.
void back_to_schema_20(Sqlite& old) {
  old.run(
      "DROP TRIGGER training_case_keeps_its_sight_law; DROP INDEX audit_of_changes; DROP INDEX "
      "audit_of_everybodys_records; DROP INDEX metric_value_hit; DROP INDEX attempt_by_seed");
  old.run("ALTER TABLE training_case DROP COLUMN sight_law");
  old.run("DROP TRIGGER training_case_keeps_its_probe; ALTER TABLE training_case DROP COLUMN probe_is_chosen");
  for (const char* later :
       {"DROP TRIGGER training_case_keeps_its_motion", "ALTER TABLE training_case DROP COLUMN breath_law",
        "ALTER TABLE training_case DROP COLUMN ct_breath",
        "CREATE TRIGGER training_case_keeps_its_motion BEFORE UPDATE OF breath_depth ON training_case "
        "BEGIN SELECT 1; END"})
    old.run(later);  // as schema 20 has one law of breath
  for (const char* later :
       {"DROP TRIGGER training_case_keeps_its_touch", "ALTER TABLE training_case DROP COLUMN instrument_tip",
        "ALTER TABLE training_case DROP COLUMN touch_law"})
    old.run(later);  // and one law of touch
  old.run("ALTER TABLE lesion DROP COLUMN lesion_kind; ALTER TABLE case_label_map DROP COLUMN wins");
  for (const char* later :
       {"DROP VIEW consenting", "DROP TRIGGER person_kind_is_immutable",
        "DROP TRIGGER simulated_people_have_no_account", "DROP TRIGGER simulated_people_make_simulated_attempts",
        "DROP TABLE simulated_truth", "ALTER TABLE person DROP COLUMN kind",
        "CREATE VIEW consenting AS SELECT '' AS study_id, '' AS person_id"})
    old.run(later);  // as schema 20 has no simulated people
  for (const char* later : {"case_preparation",
                            "asked_event",
                            "password_link",
                            "web_session",
                            "cut",
                            "rating",
                            "rating_known",
                            "rating_view",
                            "rating_rater",
                            "rating_round",
                            "attempt_comment",
                            "workshop_tick",
                            "workshop_participant",
                            "workshop_group",
                            "workshop_station",
                            "workshop",
                            "desk_response",
                            "response",
                            "response_set",
                            "questionnaire_group",
                            "questionnaire_round",
                            "questionnaire",
                            "study_plan",
                            "study_stratum",
                            "study_enrolment",
                            "study_look",
                            "study_deviation",
                            "study_lock"})
    old.run(std::string("DROP TABLE ") + later);  // as schema 20 has them not yet
  old.run("PRAGMA user_version = 20");
}

// Until schema 20 each metric had its digest: such a copy is verified as it is, and migrated its damage stays told.
TEST_F(DamageTest, DigestsOfSchema20AreReadAndTakenOver) {
  std::string attempt_id;
  {
    Library library = open_library(folder_);
    attempt_id = attempt_by(library, zoe_);
    const std::string cohort = add_cohort(library, "2026 autumn", "Radiology", "").value();
    ASSERT_TRUE(enrol(library, cohort, zoe_, Post::learner));
  }
  {
    Sqlite old(folder_ / kDatabaseFile);
    back_to_schema_20(old);
    Transaction transaction(old);
    renew_digests(old, {});
    transaction.commit();
    EXPECT_EQ(old.integer("SELECT count(*) FROM digest WHERE of_id = '" + attempt_id + "/path_tip'"), 1);
    EXPECT_EQ(old.integer("SELECT count(*) FROM digest WHERE of_table = 'enrolment' AND of_id GLOB '*/*'"), 0);
    EXPECT_TRUE(problems_of(old).empty());
  }
  change_unseen("UPDATE metric_value SET value = 72.5 WHERE metric_id = 'path_tip'");
  {
    Sqlite old(folder_ / kDatabaseFile);
    ASSERT_EQ(problems_of(old).size(), 1U);
  }
  const std::vector<std::string> told{"value_damaged: a value of attempt " + attempt_id +
                                      " is not what was stored"};
  EXPECT_EQ(found(), told) << "the check migrates";
  EXPECT_EQ(integer("PRAGMA user_version"), std::ssize(library_schema().steps));
  EXPECT_EQ(integer("SELECT count(*) FROM digest WHERE of_id = '" + attempt_id + "/path_tip'"), 0);
  change_unseen("UPDATE metric_value SET value = 71.5 WHERE metric_id = 'path_tip'");
  EXPECT_EQ(found(), none_);
}

}  // namespace
}  // namespace seldinger::casedb
