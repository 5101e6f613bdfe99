// When somebody's progress is asked for anew: of each act, whom it concerns; and that nothing is missed.
#include <set>

#include "casedb/cases/versions.h"
#include "casedb/database/audit.h"
#include "casedb/grading/learner_records.h"
#include "tests/casedb/graded_library.h"
#include "tests/fixtures/cohort.h"
#include "tests/fixtures/sound_check.h"

namespace seldinger::casedb {
namespace {

class RecordsMark : public GradedLibrary {
 protected:
  std::string tom_ = (user("Mia", Role::mentor), user("Dan", Role::director), user("Tom", Role::trainee)),
              eva_ = user("Eva", Role::trainee);

  void SetUp() override { fixtures::make_cohort(library_, "Mia", {"Eva"}); }
  // What a page would show of somebody, in words.
  std::string told(const std::string& person_id) {
    std::string words;
    for (const CurriculumRecord& record : records_of(library_, person_id)) {
      words += record.curriculum.title + ":";
      for (const ItemState& item : record.items) {
        words += " " + item.title + "/" + item.case_id + "/" + std::to_string(item.version) + "/" +
                 std::to_string(item.attempts) + "/" + std::to_string(item.passes) +
                 (item.progress.open ? "/open" : "");
        for (const assessment::GradedAttempt& one : item.graded) words += "," + one.attempt_id;
      }
      words += "\n";
    }
    return words;
  }
  struct Seen {
    std::string told, mark;
  };
  Seen look(const std::string& person_id) { return {told(person_id), records_mark(library_, person_id)}; }
  std::string published() {
    case_id_ = add_case(library_, sample_case());
    lesion_id_ = add_lesion(library_, case_id_, sample_lesion()).value();
    rule({"hit >= 1"}, {}, {});
    publish(case_id_);
    return case_id_;
  }
  void publish(const std::string& case_id) {
    static_cast<void>(confirm_no_burned_in_text(library_, case_id, std::nullopt));
    ASSERT_TRUE(publish_case(library_, case_id, fixtures::sound_check(library_, case_id), "Mia", true).has_value());
  }
};

TEST_F(RecordsMark, OfEachActItIsKnownWhomItConcerns) {
  const std::set<Act> everybody = {Act::publish_case,       Act::retire_case,
                                   Act::publish_curriculum, Act::retire_curriculum,
                                   Act::import_cases,       Act::erase_case,
                                   Act::recompute,          Act::repair,
                                   Act::accept_damaged,     Act::restore},
                      one = {Act::enrol, Act::end_enrolment};
  for (std::size_t i = 0; i < kActs; ++i) {
    const Act act = static_cast<Act>(i);
    const std::string tom = records_mark(library_, tom_), eva = records_mark(library_, eva_);
    Transaction transaction(library_.database());
    audit(library_, act, {"person", tom_});
    transaction.commit();
    EXPECT_EQ(records_mark(library_, tom_) != tom, everybody.contains(act) || one.contains(act)) << name_of(act);
    EXPECT_EQ(records_mark(library_, eva_) != eva, everybody.contains(act)) << name_of(act);
  }
}

TEST_F(RecordsMark, IsAnotherOneWheneverSomethingElseIsTold) {
  const std::string one = published(), two = published();
  const std::string curriculum_id = add_curriculum(library_, "First year", "Mia").value();
  std::string version_id;
  const std::vector<std::pair<const char*, std::function<void()>>> acts = {
      {"an item",
       [&] { static_cast<void>(add_curriculum_item(library_, curriculum_id, one, {}, {}, "Mia").value()); }},
      {"another",
       [&] { static_cast<void>(add_curriculum_item(library_, curriculum_id, two, 5, {}, "Mia").value()); }},
      {"published", [&] { ASSERT_TRUE(publish_curriculum(library_, curriculum_id, "Dan").has_value()); }},
      {"an enrolment",
       [&] { ASSERT_TRUE(enrol(library_, list_cohorts(library_)[0].cohort_id, tom_, Post::learner).has_value()); }},
      {"an attempt", [&] { attempt(tom_, 1.0, 20.0); }},
      {"another's attempt", [&] { attempt(eva_, 0.0, 20.0); }},
      {"a version", [&] { version_id = new_version(library_, one, "Mia").value(); }},
      {"its publication", [&] { publish(version_id); }},
      {"a retired case", [&] { ASSERT_TRUE(retire_case(library_, two, "Mia").has_value()); }},
      {"a retired curriculum",
       [&] { ASSERT_TRUE(remove_curriculum(library_, curriculum_id, "Dan").has_value()); }}};
  int changed = 0;
  for (const auto& [words, act] : acts) {
    const Seen tom = look(tom_), eva = look(eva_);
    act();
    for (const auto& [before, after] : {std::pair{tom, look(tom_)}, {eva, look(eva_)}})
      if (before.told != after.told) {
        EXPECT_NE(before.mark, after.mark) << words;
        ++changed;
      }
  }
  EXPECT_GE(changed, 8) << "acts that change nothing would pass";
}

TEST_F(RecordsMark, ReadsARowWhateverTheLogHolds) {
  Statement plan = library_.database().prepare(
      "EXPLAIN QUERY PLAN SELECT sequence FROM audit WHERE act IN ('publish_case', 'retire_case', "
      "'publish_curriculum', "
      "'retire_curriculum', 'import_cases', 'erase_case', 'recompute', 'repair', 'accept_damaged', 'restore') "
      "ORDER BY "
      "sequence DESC LIMIT 1");
  ASSERT_TRUE(plan.step());
  EXPECT_NE(plan.text("detail").find("audit_of_everybodys_records"), std::string::npos) << plan.text("detail");
}

}  // namespace
}  // namespace seldinger::casedb
