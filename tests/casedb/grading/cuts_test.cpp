// Cuts: proposed with their data, frozen by a second person, and then as they are.
#include "casedb/grading/cuts.h"

#include <gmock/gmock.h>

#include "casedb/database/audit.h"
#include "casedb/database/sqlite.h"
#include "tests/casedb/graded_library.h"

namespace seldinger::casedb {
namespace {

using assessment::statistics::DataTable;
using assessment::statistics::Procedure;
using assessment::statistics::ProcedureOptions;
using ::testing::HasSubstr;
using ::testing::Not;

const Procedure* method(const std::string& name) {
  for (const Procedure* one : cut_methods())
    if (one->name == name) return one;
  return nullptr;
}

// Millimetres of novices and of experts, who are nearer.
DataTable groups() {
  DataTable table;
  table.values.push_back({"mm", {9, 8, 10, 7, 11, 9.5, 3, 2, 4, 3.5, 2.5, 3.2}});
  table.rows = table.values.front().values.size();
  for (std::size_t i = 0; i < table.rows; ++i) {
    table.group.emplace_back(i < 6 ? "novice" : "expert, \"sure\"");
    table.subject.push_back("Dr. Planted " + std::to_string(i));
  }
  return table;
}

class CutsTest : public GradedLibrary {
 protected:
  void SetUp() override {
    user("Mona", Role::mentor);
    user("Dora", Role::director);
    user("Dirk", Role::director);
    user("Tina", Role::trainee);
  }
  NewCut new_cut(DataTable data = groups()) {
    return {case_id_, "tip_target_dist", method("contrasting_groups"), ProcedureOptions(), std::move(data)};
  }
  std::string proposed(const std::string& by = "Mona") { return propose_cut(library_, new_cut(), by).value(); }
};

TEST_F(CutsTest, AreOfTheVersionThatIsMeasuredAtTheCase) {
  const int newest = assessment::find_metric("vis_joint")->version;
  NewCut of_sight = new_cut();
  of_sight.metric_id = "vis_joint";
  ASSERT_TRUE(propose_cut(library_, of_sight, "Mona"));
  EXPECT_EQ(list_cuts(library_, case_id_).at(0).version, newest);
  library_.database().run("DROP TRIGGER training_case_keeps_its_sight_law");
  library_.database().run("UPDATE training_case SET sight_law = 'echo'");
  ASSERT_TRUE(propose_cut(library_, of_sight, "Mona"));
  const auto cuts = list_cuts(library_, case_id_);
  ASSERT_EQ(cuts.size(), 2U);
  EXPECT_EQ(std::min(cuts[0].version, cuts[1].version), newest - 4);
  EXPECT_EQ(std::max(cuts[0].version, cuts[1].version), newest);
}

TEST_F(CutsTest, AreProposedWithTheirDataAndTheMetricsBetterSide) {
  const std::string id = proposed();
  const auto cuts = list_cuts(library_, case_id_);
  ASSERT_EQ(cuts.size(), 1U);
  const Cut& cut = cuts.front();
  EXPECT_EQ(cut.cut_id, id);
  EXPECT_EQ(cut.metric_id, "tip_target_dist");
  EXPECT_FALSE(cut.higher_is_better);
  EXPECT_GT(cut.value, 4.0);
  EXPECT_LT(cut.value, 7.0);
  ASSERT_TRUE(cut.interval.has_value());
  EXPECT_LE(cut.interval->low, cut.value);
  EXPECT_GE(cut.interval->high, cut.value);
  EXPECT_EQ(cut.n, 12U);
  EXPECT_FALSE(cut.frozen_us.has_value());
  EXPECT_THAT(cut.data, HasSubstr("value,group,subject\n9,\"novice\",s1\n"));
  EXPECT_THAT(cut.data, HasSubstr("3,\"expert, \"\"sure\"\"\",s7\n"));
  EXPECT_THAT(cut.data, Not(HasSubstr("Planted"))) << "nobody is named";
  EXPECT_EQ(list_audit(library_).back().act, "propose_cut");
}

TEST_F(CutsTest, ASecondPersonFreezesThem) {
  const std::string id = proposed("Dora");
  EXPECT_EQ(freeze_cut(library_, id, "Dora").error().code, "not_allowed") << "the same person";
  EXPECT_EQ(freeze_cut(library_, id, "Mona").error().code, "not_allowed") << "no director";
  EXPECT_EQ(cut_in_force(list_cuts(library_, case_id_), "tip_target_dist"), nullptr);
  ASSERT_TRUE(freeze_cut(library_, id, "Dirk"));
  EXPECT_EQ(list_audit(library_).back().act, "freeze_cut");
  const auto cuts = list_cuts(library_, case_id_);
  ASSERT_NE(cut_in_force(cuts, "tip_target_dist"), nullptr);
  EXPECT_EQ(cut_in_force(cuts, "hit"), nullptr);
  EXPECT_NE(cuts.front().frozen_by, cuts.front().proposed_by);
  EXPECT_EQ(freeze_cut(library_, id, "Dirk").error().code, "cut_frozen");
  EXPECT_EQ(freeze_cut(library_, "nowhere", "Dirk").error().code, "no_cut");
}

TEST_F(CutsTest, TheLastThatWasFrozenHolds) {
  const std::string first = proposed(), second = proposed();
  ASSERT_TRUE(freeze_cut(library_, second, "Dora"));
  ASSERT_TRUE(freeze_cut(library_, first, "Dora"));
  EXPECT_EQ(cut_in_force(list_cuts(library_, case_id_), "tip_target_dist")->cut_id, first);
}

TEST_F(CutsTest, AreRefusedWithAReasonAndNothingIsStored) {
  EXPECT_EQ(propose_cut(library_, new_cut(), "Tina").error().code, "not_allowed");
  EXPECT_EQ(propose_cut(library_, new_cut(), "Nobody").error().code, "no_user");
  NewCut other = new_cut();
  other.metric_id = "no_such_metric";
  EXPECT_EQ(propose_cut(library_, other, "Mona").error().code, "unknown_metric");
  other = new_cut();
  other.case_id = "nowhere";
  EXPECT_EQ(propose_cut(library_, other, "Mona").error().code, "no_case");
  DataTable few = groups();  // four of the novices are unknown
  for (std::size_t i = 0; i < 4; ++i) few.values.front().values[i] = std::nan("");
  const auto refused = propose_cut(library_, new_cut(few), "Mona");
  EXPECT_EQ(refused.error().code, "cut_not_estimable");
  EXPECT_THAT(refused.error().text, HasSubstr("a group has too few values"));
  EXPECT_TRUE(list_cuts(library_, case_id_).empty());
}

TEST_F(CutsTest, JudgesSayAShareOfItems) {
  DataTable judged;
  for (int judge = 0; judge < 4; ++judge)
    for (int item = 0; item < 3; ++item) {
      judged.rater.push_back("judge " + std::to_string(judge));
      judged.subject.push_back("item " + std::to_string(item));
      if (judged.values.empty()) judged.values.push_back({"share", {}});
      judged.values.front().values.push_back(0.5 + 0.05 * judge);
      ++judged.rows;
    }
  const NewCut cut{case_id_, "", method("angoff"), ProcedureOptions(), judged};
  ASSERT_TRUE(propose_cut(library_, cut, "Mona"));
  const Cut stored = list_cuts(library_, case_id_).front();
  EXPECT_TRUE(stored.metric_id.empty());
  EXPECT_TRUE(stored.higher_is_better);
  EXPECT_NEAR(stored.value, 0.575, 1e-12);
  EXPECT_THAT(stored.data, HasSubstr("0.5,s1,j1\n"));
}

TEST_F(CutsTest, TheDatabaseKeepsThemAsTheyAre) {
  const std::string id = proposed();
  for (const char* change : {"UPDATE cut SET value = 1", "UPDATE cut SET data = 'x'", "DELETE FROM cut",
                             "UPDATE cut SET frozen_by = proposed_by, frozen_us = 1",
                             "UPDATE cut SET metric_id = NULL, version = NULL"}) {
    const Transaction trying(library_.database());
    EXPECT_THROW(library_.database().run(change), DatabaseFailure) << change;
  }
  ASSERT_TRUE(freeze_cut(library_, id, "Dora"));
  const Transaction trying(library_.database());
  EXPECT_THROW(library_.database().run("UPDATE cut SET frozen_us = NULL, frozen_by = NULL"), DatabaseFailure);
}

}  // namespace
}  // namespace seldinger::casedb
