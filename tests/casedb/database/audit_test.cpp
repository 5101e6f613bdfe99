// The audit log: it grows with each act and with nothing else, nobody changes it through the library, and whoever
// changes the file beside it is told of. Before schema 17 there was none: three decisions by one hand left no
// trace.
#include "casedb/database/audit.h"

#include <set>

#include "casedb/cases/authoring.h"
#include "casedb/people/people.h"
#include "tests/casedb/library_samples.h"

namespace seldinger::casedb {
namespace {

class AuditTest : public testing::Test {
 protected:
  std::filesystem::path folder_ = fresh_folder() / "library";
  Library library_ = open_library(folder_);

  void SetUp() override {
    for (int i = 0; i < 6; ++i) audit_alone(library_, Act::back_up);
  }
  std::vector<std::string> acts() {
    std::vector<std::string> all;
    for (const AuditRow& row : list_audit(library_)) all.push_back(row.act);
    return all;
  }
  // Of somebody who has the file, and takes the triggers away first.
  void tamper(const std::string& sql) {
    Sqlite database(folder_ / kDatabaseFile);
    database.run(
        "PRAGMA foreign_keys = OFF; DROP TRIGGER audit_is_immutable; DROP TRIGGER audit_is_kept; "
        "DROP TRIGGER audit_goes_on; DROP TRIGGER audit_head_goes_on; " +
        sql);
  }
  std::string codes() {
    std::string all;
    for (const base::Problem& one : problems_of_audit(library_)) all += one.code + " ";
    return all;
  }
};

TEST_F(AuditTest, CodesAreEachAnothersAndFitTheSchema) {
  std::set<std::string_view> names;
  for (std::size_t i = 0; i < kActs; ++i) {
    const auto act = static_cast<Act>(i);
    EXPECT_TRUE(names.insert(name_of(act)).second) << name_of(act);
    EXPECT_EQ(name_of(act).find_first_not_of("abcdefghijklmnopqrstuvwxyz_"), std::string_view::npos);
    EXPECT_FALSE(words_of(act).empty());
    audit_alone(library_, act);
  }
  EXPECT_EQ(list_audit(library_).size(), 6 + kActs);
  EXPECT_EQ(codes(), "");
}

TEST_F(AuditTest, ARowTellsWhoDidWhatToWhichThing) {
  const std::string person_id = add_user(library_, "ann", Role::mentor, "a password").value();
  library_.act_for(Actor::person(person_id));
  const std::string case_id = add_case(library_, sample_case());
  library_.act_for({ActorKind::library_operator, person_id});
  ASSERT_TRUE(set_title(library_, case_id, "Another"));
  const auto rows = list_audit(library_);
  ASSERT_EQ(rows.size(), 9U);
  EXPECT_EQ(rows[6].act, "add_account");
  EXPECT_EQ(rows[6].actor, "operator");
  EXPECT_FALSE(rows[6].person_id.has_value());
  EXPECT_EQ(rows[6].object_id, person_id);
  EXPECT_EQ(rows[7].actor, "person");
  EXPECT_EQ(rows[7].person_id, person_id);
  EXPECT_EQ(rows[7].object, "case");
  EXPECT_EQ(rows[7].object_id, case_id);
  EXPECT_EQ(rows[8].act, "change_case");
  EXPECT_EQ(rows[8].actor, "operator");
  EXPECT_EQ(rows[8].person_id, person_id);
  EXPECT_TRUE(entered_by_operator(library_.database(), Act::change_case, case_id));
  EXPECT_FALSE(entered_by_operator(library_.database(), Act::add_case, case_id));
  EXPECT_EQ(audit_head(library_).count, 9);
  EXPECT_EQ(audit_head(library_).hash, rows[8].hash);
  EXPECT_EQ(list_audit(library_, rows[7].at_us).size(), rows[6].at_us == rows[7].at_us ? 3U : 2U);
}

TEST_F(AuditTest, WhatWasNotDoneIsNotInIt) {
  {
    Transaction transaction(library_.database());
    audit(library_, Act::set_role, {});
  }  // rolled back
  EXPECT_FALSE(set_title(library_, "no case", "x"));
  EXPECT_EQ(acts().size(), 6U);
  EXPECT_EQ(codes(), "");
}

TEST_F(AuditTest, ThroughTheLibraryNothingOfItIsChanged) {
  for (const char* sql :
       {"UPDATE audit SET result = 'refused' WHERE sequence = 2", "DELETE FROM audit",
        "DELETE FROM audit WHERE sequence = 6", "DELETE FROM audit_head", "UPDATE audit_head SET count = 3",
        "UPDATE audit_head SET hash = count",
        "INSERT INTO audit SELECT 9, at_us, actor, person_id, act, object, object_id, result, hash "
        "FROM audit WHERE sequence = 1",
        "INSERT OR REPLACE INTO audit SELECT * FROM audit WHERE sequence = 1"})
    EXPECT_THROW(library_.database().run(sql), DatabaseFailure) << sql;
  EXPECT_EQ(codes(), "");
}

TEST_F(AuditTest, NoNameAndNothingTypedFitsIntoIt) {
  for (const Object& bad : {Object{"case", "Zebedee Quagmire"}, Object{"Ann", ""}, Object{"case", "a\nb"}})
    EXPECT_THROW(audit_alone(library_, Act::add_case, bad), DatabaseFailure);
  EXPECT_EQ(acts().size(), 6U);
}

TEST_F(AuditTest, AFlippedByteIsTold) {
  tamper("UPDATE audit SET at_us = at_us + 1 WHERE sequence = 3");
  EXPECT_EQ(codes(), "audit_changed ");
}

TEST_F(AuditTest, EachColumnIsPartOfTheHash) {
  const std::string person_id = add_user(library_, "ann", Role::mentor, "a password").value();
  const std::string changes[] = {"actor = 'nobody'",
                                 "act = 'log_in'",
                                 "object = 'case'",
                                 "object_id = 'x'",
                                 "result = 'refused'",
                                 "person_id = '" + person_id + "'",
                                 "hash = replace(hash, substr(hash, 1, 1), 'x')"};
  tamper("CREATE TABLE kept AS SELECT * FROM audit");
  for (const std::string& change : changes) {
    library_.database().run("UPDATE audit SET " + change + " WHERE sequence = 4");
    EXPECT_NE(codes(), "") << change;
    library_.database().run("DELETE FROM audit; INSERT INTO audit SELECT * FROM kept");
    EXPECT_EQ(codes(), "") << "as it was";
  }
}

TEST_F(AuditTest, ADeletedRowIsTold) {
  tamper("DELETE FROM audit WHERE sequence = 3");
  EXPECT_EQ(codes(), "audit_missing ");
}

TEST_F(AuditTest, ADeletedRowIsToldWhenTheOthersMoveUp) {
  tamper(
      "DELETE FROM audit WHERE sequence = 3; UPDATE audit SET sequence = sequence - 1 WHERE sequence > 3; "
      "UPDATE audit_head SET count = count - 1");
  EXPECT_NE(codes().find("audit_changed "), std::string::npos) << codes();
}

TEST_F(AuditTest, SwappedRowsAreTold) {
  tamper(
      "UPDATE audit SET sequence = 100 WHERE sequence = 2; UPDATE audit SET sequence = 2 WHERE sequence = 4; "
      "UPDATE audit SET sequence = 4 WHERE sequence = 100");
  EXPECT_NE(codes().find("audit_changed "), std::string::npos) << codes();
}

TEST_F(AuditTest, ACutEndIsTold) {
  tamper("DELETE FROM audit WHERE sequence > 4");
  EXPECT_EQ(codes(), "audit_cut ");
}

TEST_F(AuditTest, ACutEndWhoseHeadWasSetBackIsToldByItsHash) {
  tamper("DELETE FROM audit WHERE sequence > 4; UPDATE audit_head SET count = 4");
  EXPECT_EQ(codes(), "audit_changed ");
}

TEST_F(AuditTest, AHeadThatWasNotedElsewhereTellsWhatTheChainCannot) {
  const AuditRow fourth = list_audit(library_)[3];
  const AuditHead noted = audit_head(library_);
  audit_alone(library_, Act::repair);
  EXPECT_TRUE(still_stands(library_, noted));
  tamper("DELETE FROM audit WHERE sequence > 4; UPDATE audit_head SET count = 4, hash = '" + fourth.hash + "'");
  EXPECT_EQ(codes(), "") << "cut and set back to fit: the chain alone cannot know";
  EXPECT_FALSE(still_stands(library_, noted));
  audit_alone(library_, Act::repair);
  audit_alone(library_, Act::repair);
  EXPECT_FALSE(still_stands(library_, noted)) << "another row stands there now";
  EXPECT_TRUE(still_stands(library_, {4, fourth.hash}));
}

TEST_F(AuditTest, AnEmptiedLogIsTold) {
  tamper("DELETE FROM audit");
  EXPECT_EQ(codes(), "audit_cut ");
}

}  // namespace
}  // namespace seldinger::casedb
