// Curricula: who makes, publishes and retires one; what of it never changes; how far somebody is.
#include "casedb/grading/learner_records.h"

#include "casedb/cases/versions.h"
#include "tests/casedb/graded_library.h"
#include "tests/fixtures/cohort.h"
#include "tests/fixtures/sound_check.h"

namespace seldinger::casedb {
namespace {

using assessment::Gate;
using assessment::Proficiency;

class CurriculumTest : public GradedLibrary {
 protected:
  std::string person_ = (user("Mia", Role::mentor), user("Dan", Role::director), user("Tom", Role::trainee));

  void SetUp() override { fixtures::make_cohort(library_, "Mia", {"Tom"}); }

  // A published case that asks for a hit within 30 s.
  std::string published(std::optional<int> attempt_limit = {}) {
    case_id_ = add_case(library_, sample_case());
    lesion_id_ = add_lesion(library_, case_id_, sample_lesion()).value();
    rule({"hit >= 1", "time_total <= 30"}, {}, attempt_limit);
    publish(case_id_);
    return case_id_;
  }
  void publish(const std::string& case_id) {
    static_cast<void>(confirm_no_burned_in_text(library_, case_id, std::nullopt));
    const CaseCheck check = fixtures::sound_check(library_, case_id);
    ASSERT_TRUE(publish_case(library_, case_id, check, "Mia", true).has_value());
  }
  std::string new_curriculum() { return add_curriculum(library_, "First year", "Mia").value(); }
  void done(bool passes) { attempt(person_, passes ? 1.0 : 0.0, 20.0); }
  std::vector<ItemState> states(const std::string& curriculum_id) {
    return states_of(library_, find_curriculum(library_, curriculum_id).value(), person_);
  }
};

template <typename T>
std::string code(const base::Result<T>& result) {
  return result ? "none" : result.error().code;
}

TEST_F(CurriculumTest, ComesBackAsItWasMade) {
  const std::string one = published(), two = published();
  const std::string id = new_curriculum();
  EXPECT_EQ(add_curriculum_item(library_, id, one, {}, {}, "Mia").value(), 1);
  EXPECT_EQ(add_curriculum_item(library_, id, two, 5, {{0, Proficiency::proficient}}, "mia").error().code,
            "no_user")
      << "names are exact here, as where cases are decided about";
  EXPECT_EQ(add_curriculum_item(library_, id, two, 5, {{0, Proficiency::proficient}}, "Mia").value(), 2);
  const Curriculum read = find_curriculum(library_, id).value();
  EXPECT_EQ(read.title, "First year");
  EXPECT_EQ(read.state, CurriculumState::draft);
  ASSERT_EQ(read.items.size(), 2U);
  EXPECT_EQ(read.items[1].family_id, two);
  EXPECT_EQ(read.items[1].attempt_limit, 5);
  ASSERT_EQ(read.items[1].gates.size(), 1U);
  EXPECT_EQ(read.items[1].gates[0].after, 0U);
  EXPECT_EQ(read.items[1].gates[0].reached, Proficiency::proficient);
  EXPECT_EQ(list_curricula(library_).size(), 1U);
}

TEST_F(CurriculumTest, MentorsMakeAndDirectorsPublish) {
  const std::string one = published();
  for (const char* name : {"Tom", "Dan"}) EXPECT_EQ(code(add_curriculum(library_, "X", name)), "not_allowed");
  EXPECT_EQ(code(add_curriculum(library_, "X", "Nobody")), "no_user");
  const std::string id = new_curriculum();
  for (const char* name : {"Tom", "Dan"})
    EXPECT_EQ(code(add_curriculum_item(library_, id, one, {}, {}, name)), "not_allowed");
  static_cast<void>(add_curriculum_item(library_, id, one, {}, {}, "Mia").value());
  for (const char* name : {"Tom", "Mia"}) EXPECT_EQ(code(publish_curriculum(library_, id, name)), "not_allowed");
  EXPECT_EQ(code(publish_curriculum(library_, id, "Dan")), "none");
  for (const char* name : {"Tom", "Mia"}) EXPECT_EQ(code(remove_curriculum(library_, id, name)), "not_allowed");
  EXPECT_EQ(code(remove_curriculum(library_, id, "Dan")), "none");
  EXPECT_EQ(find_curriculum(library_, id).value().state, CurriculumState::retired);
  EXPECT_EQ(code(remove_curriculum(library_, id, "Dan")), "bad_state");
}

TEST_F(CurriculumTest, WhatDoesNotFitIsRefused) {
  const std::string draft = case_id_, one = published(), two = published();
  for (const std::string& title : {std::string(), std::string("a\nb"), std::string(201, 'x'), std::string("\xff")})
    EXPECT_EQ(code(add_curriculum(library_, title, "Mia")), "bad_title");
  const std::string id = new_curriculum();
  EXPECT_EQ(code(publish_curriculum(library_, id, "Dan")), "no_items");
  const auto add = [&](const std::string& case_id, std::optional<int> limit, std::vector<Gate> gates) {
    return code(add_curriculum_item(library_, id, case_id, limit, gates, "Mia"));
  };
  EXPECT_EQ(add(draft, {}, {}), "not_published");
  EXPECT_EQ(add(std::string(36, '0'), {}, {}), "no_case");
  EXPECT_EQ(add(one, 0, {}), "bad_item");
  EXPECT_EQ(add(one, 1001, {}), "bad_item");
  EXPECT_EQ(add(one, {}, {{0, Proficiency::passed}}), "bad_item") << "itself";
  EXPECT_EQ(add(one, {}, {}), "none");
  EXPECT_EQ(add(one, {}, {}), "case_taken");
  EXPECT_EQ(add(two, {}, {{0, Proficiency::practising}}), "bad_item");
  EXPECT_EQ(add(two, {}, {{0, Proficiency::passed}, {0, Proficiency::proficient}}), "bad_item");
  EXPECT_EQ(find_curriculum(library_, id).value().items.size(), 1U) << "nothing of what was refused is there";
  ASSERT_TRUE(retire_case(library_, one, "Mia").has_value());
  EXPECT_EQ(code(publish_curriculum(library_, id, "Dan")), "not_published");
  EXPECT_EQ(code(remove_curriculum(library_, id, "Mia")), "none");
  EXPECT_TRUE(list_curricula(library_).empty());
  EXPECT_EQ(code(remove_curriculum(library_, id, "Mia")), "no_curriculum");
}

TEST_F(CurriculumTest, WhatIsPublishedStaysAsItIs) {
  const std::string one = published(), two = published();
  const std::string id = new_curriculum();
  static_cast<void>(add_curriculum_item(library_, id, one, {}, {}, "Mia").value());
  ASSERT_EQ(code(publish_curriculum(library_, id, "Dan")), "none");
  EXPECT_EQ(code(add_curriculum_item(library_, id, two, {}, {}, "Mia")), "not_a_draft");
  EXPECT_EQ(code(publish_curriculum(library_, id, "Dan")), "not_a_draft");
  ASSERT_TRUE(set_level(library_, "Tom", Level::trainee).has_value());
  for (const char* change :
       {"DELETE FROM curriculum", "DELETE FROM curriculum_item", "UPDATE curriculum SET title = 'Y'",
        "UPDATE curriculum SET state = 'draft'", "UPDATE curriculum_item SET attempt_limit = 3",
        "INSERT INTO curriculum_item SELECT curriculum_id, 2, '000000000000000000000000000000000000', NULL FROM "
        "curriculum",
        "UPDATE person_level SET level = 'student'"}) {
    EXPECT_TRUE(refused_by_constraint([&] { library_.database().run(change); })) << change;
  }
}

TEST_F(CurriculumTest, TellsHowFarSomebodyIs) {
  const std::string two = published(4);
  const std::string one = published();  // the fixture's attempts are on this one
  const std::string id = new_curriculum();
  static_cast<void>(add_curriculum_item(library_, id, one, 6, {}, "Mia").value());
  static_cast<void>(add_curriculum_item(library_, id, two, {}, {{0, Proficiency::proficient}}, "Mia").value());
  auto at = states(id);
  EXPECT_EQ(at[0].case_id, one);
  EXPECT_EQ(at[0].progress.reached, Proficiency::not_started);
  EXPECT_TRUE(at[0].progress.due);
  EXPECT_EQ(at[0].progress.attempts_left, 6);
  EXPECT_EQ(at[1].progress.attempts_left, 4) << "the case's own limit";
  EXPECT_FALSE(at[1].progress.open);
  done(false);
  EXPECT_EQ(states(id)[0].progress.reached, Proficiency::practising);
  done(true);
  EXPECT_EQ(states(id)[0].progress.reached, Proficiency::passed);
  EXPECT_FALSE(states(id)[1].progress.open);
  done(false);
  done(true);
  EXPECT_EQ(states(id)[0].progress.reached, Proficiency::passed) << "two passes, not in a row";
  NewAttempt simulated = new_attempt(person_, 1.0, 20.0);
  simulated.operator_name = "expert";
  static_cast<void>(add_attempt(library_, simulated).value());
  EXPECT_EQ(states(id)[0].progress.reached, Proficiency::passed) << "what was simulated in somebody's name";
  done(true);
  at = states(id);
  EXPECT_EQ(at[0].progress.reached, Proficiency::proficient);
  EXPECT_EQ(at[0].attempts, 5);
  EXPECT_EQ(at[0].passes, 3);
  EXPECT_EQ(at[0].progress.attempts_left, 1);
  EXPECT_TRUE(at[1].progress.open && at[1].progress.due);
  EXPECT_EQ(states_of(library_, find_curriculum(library_, id).value())[0].title, "Kidney A");
}

TEST_F(CurriculumTest, AnItemsOwnLimitStandsInPlaceOfTheCases) {
  const std::string tight = published(4);
  std::string id = new_curriculum();
  static_cast<void>(add_curriculum_item(library_, id, tight, 2, {}, "Mia").value());
  done(true);
  done(false);
  done(true);  // a draft binds nobody
  ASSERT_EQ(code(publish_curriculum(library_, id, "Dan")), "none");
  EXPECT_EQ(code(add_attempt(library_, new_attempt(person_, 1.0, 20.0))), "no_attempts_left");
  EXPECT_EQ(code(open_attempt(library_, new_attempt(person_, 1.0, 20.0))), "no_attempts_left");
  // Of two curricula the more generous counts, here the one that leaves it to the case: four.
  id = new_curriculum();
  static_cast<void>(add_curriculum_item(library_, id, tight, {}, {}, "Mia").value());
  ASSERT_EQ(code(publish_curriculum(library_, id, "Dan")), "none");
  done(true);
  EXPECT_EQ(code(add_attempt(library_, new_attempt(person_, 1.0, 20.0))), "no_attempts_left");
  // An item without end, on a case without: nobody is stopped.
  const std::string endless = published();
  id = new_curriculum();
  static_cast<void>(add_curriculum_item(library_, id, endless, {}, {}, "Mia").value());
  ASSERT_EQ(code(publish_curriculum(library_, id, "Dan")), "none");
  for (int i = 0; i < 5; ++i) done(false);
}

TEST_F(CurriculumTest, PassesCarryOverToANewVersionAndUsedUpAttemptsDoNot) {
  const std::string first = published(3);
  const std::string id = new_curriculum();
  static_cast<void>(add_curriculum_item(library_, id, first, {}, {}, "Mia").value());
  done(false);
  done(true);
  EXPECT_EQ(states(id)[0].progress.attempts_left, 1);
  case_id_ = new_version(library_, first, "Mia").value();
  lesion_id_ = list_lesions(library_, case_id_)[0].lesion_id;
  rule({"hit >= 1", "time_total <= 10"}, {}, 3);
  EXPECT_EQ(states(id)[0].case_id, first) << "a draft is nobody's case";
  publish(case_id_);
  auto at = states(id);
  EXPECT_EQ(at[0].case_id, case_id_);
  EXPECT_EQ(at[0].version, 2);
  EXPECT_EQ(at[0].progress.reached, Proficiency::passed);
  EXPECT_EQ(at[0].progress.attempts_left, 3);
  attempt(person_, 1.0, 9.0);
  EXPECT_EQ(states(id)[0].progress.reached, Proficiency::proficient) << "each by the rule of its own version";
  ASSERT_TRUE(retire_case(library_, case_id_, "Mia").has_value());
  EXPECT_EQ(states(id)[0].case_id, first) << "the newest that is published";
  ASSERT_TRUE(retire_case(library_, first, "Mia").has_value());
  at = states(id);
  EXPECT_TRUE(at[0].case_id.empty());
  EXPECT_FALSE(at[0].progress.due);
  EXPECT_EQ(at[0].progress.reached, Proficiency::proficient) << "what was reached stays";
}

// Before, the newest version counted, whoever it reached: its title was read everywhere, and the item was gone from
// what one may practise, so that the older version came back without its gates (choices_test.cpp).
TEST_F(CurriculumTest, AVersionForAnotherCohortIsNotTheItems) {
  const std::string first = published();
  library_.database().run("DROP TRIGGER training_case_published_keeps_its_name");
  library_.database().run("UPDATE training_case SET audience = 'everyone'");
  const std::string id = new_curriculum();
  static_cast<void>(add_curriculum_item(library_, id, first, {}, {}, "Mia").value());
  case_id_ = new_version(library_, first, "Mia").value();
  ASSERT_TRUE(set_title(library_, case_id_, "Only for Mia's"));
  publish(case_id_);
  const std::string elsewhere = user("Eve", Role::trainee);
  const auto of = [&](const std::string& person) {
    return states_of(library_, find_curriculum(library_, id).value(), person).at(0);
  };
  EXPECT_EQ(of(person_).case_id, case_id_);
  EXPECT_EQ(of(elsewhere).case_id, first);
  EXPECT_EQ(of(elsewhere).title, "Kidney A");
  EXPECT_EQ(states_of(library_, find_curriculum(library_, id).value()).at(0).case_id, case_id_) << "nobody's";
  ASSERT_TRUE(retire_case(library_, first, "Mia"));
  EXPECT_EQ(of(elsewhere).case_id, "");
  EXPECT_EQ(of(elsewhere).title, "Kidney A") << "what was published for them once";
}

}  // namespace
}  // namespace seldinger::casedb
