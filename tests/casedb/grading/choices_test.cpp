// What is listed for somebody to practise, what of it is open, and what is due: without a window.
#include "casedb/grading/choices.h"

#include <algorithm>

#include "casedb/cases/permissions.h"
#include "casedb/cases/versions.h"
#include "casedb/grading/curriculum.h"
#include "tests/casedb/graded_library.h"
#include "tests/fixtures/cohort.h"
#include "tests/fixtures/sound_check.h"

namespace seldinger::casedb {
namespace {

using assessment::Proficiency;

class ChoicesTest : public GradedLibrary {
 protected:
  std::string person_ = (user("Mia", Role::mentor), user("Ben", Role::mentor), user("Dan", Role::director),
                         user("Tom", Role::trainee));

  void SetUp() override { fixtures::make_cohort(library_, "Mia", {"Tom"}); }

  // A draft with a target that asks for a hit within 30 s; attempts are on it from here on.
  std::string draft(const std::string& title, std::optional<int> attempt_limit = {}) {
    case_id_ = add_case(library_, sample_case(title));
    lesion_id_ = add_lesion(library_, case_id_, sample_lesion()).value();
    rule({"hit >= 1", "time_total <= 30"}, {}, attempt_limit);
    return case_id_;
  }
  std::string published(const std::string& title, std::optional<int> attempt_limit = {}) {
    const std::string case_id = draft(title, attempt_limit);
    publish(case_id);
    return case_id;
  }
  void publish(const std::string& case_id) {
    ASSERT_TRUE(confirm_no_burned_in_text(library_, case_id, std::nullopt));
    ASSERT_TRUE(publish_case(library_, case_id, fixtures::sound_check(library_, case_id), "Mia", true));
  }
  // Through these cases; each opens when the one before it is passed.
  std::string curriculum(const std::string& title, const std::vector<std::string>& case_ids,
                         std::optional<int> attempt_limit = {}) {
    const std::string id = add_curriculum(library_, title, "Mia").value();
    for (std::size_t i = 0; i < case_ids.size(); ++i) {
      std::vector<assessment::Gate> gates;
      if (i > 0) gates.push_back({i - 1, Proficiency::passed});
      EXPECT_TRUE(add_curriculum_item(library_, id, case_ids[i], attempt_limit, gates, "Mia"));
    }
    return id;
  }
  void attempt_on(const std::string& case_id, bool passes) {
    case_id_ = case_id;
    lesion_id_ = list_lesions(library_, case_id).at(0).lesion_id;
    attempt(person_, passes ? 1.0 : 0.0, 20.0);
  }
  Choices choices(Role role = Role::trainee) { return choices_of(library_, person_, role); }
  static std::vector<std::string> titles(const Choices& choices) {
    std::vector<std::string> titles;
    for (const Choice& one : choices.cases)
      titles.push_back(one.curriculum.empty() ? one.title : one.curriculum + ": " + one.title);
    return titles;
  }
  static std::vector<std::string> drafts(const Choices& choices) {
    std::vector<std::string> titles;
    for (const CaseDraft& one : choices.drafts) titles.push_back(one.title);
    return titles;
  }
};
using Titles = std::vector<std::string>;

TEST_F(ChoicesTest, EverybodyPractisesWhatIsPublishedAndOnlyAMentorWorksOnDrafts) {
  draft("A draft");
  const std::string reviewed = draft("In review");
  ASSERT_TRUE(submit_case(library_, reviewed, "Mia"));
  published("Published");
  ASSERT_TRUE(retire_case(library_, published("Retired"), "Mia"));
  publish(add_case(library_, sample_case("Without a target")));
  for (const Role role : {Role::trainee, Role::researcher, Role::director, Role::admin}) {
    EXPECT_EQ(titles(choices(role)), Titles{"Published"}) << name_of(role);
    EXPECT_EQ(drafts(choices(role)), Titles{}) << name_of(role);
  }
  const Choices mentors = choices(Role::mentor);
  EXPECT_EQ(titles(mentors), Titles{"Published"});
  EXPECT_EQ(drafts(mentors), (Titles{"Kidney A", "A draft", "In review"})) << "the first is the fixture's own";
  EXPECT_EQ(mentors.drafts[1].state, CaseState::draft);
  EXPECT_EQ(mentors.drafts[2].state, CaseState::review);
  EXPECT_EQ(mentors.drafts[2].case_id, reviewed);
}

TEST_F(ChoicesTest, ADraftThatAttemptsHaveFrozenIsAMentorsToPractise) {
  const std::string frozen = draft("Frozen");
  EXPECT_EQ(titles(choices(Role::mentor)), Titles{}) << "practice would freeze it";
  attempt(std::nullopt, 1.0, 20.0);
  EXPECT_EQ(titles(choices(Role::mentor)), Titles{"Frozen"});
  EXPECT_EQ(drafts(choices(Role::mentor)), (Titles{"Kidney A", "Frozen"})) << "to be reviewed and published still";
  for (const Role role : {Role::trainee, Role::researcher, Role::director, Role::admin})
    EXPECT_EQ(titles(choices(role)), Titles{}) << name_of(role);
  ASSERT_TRUE(submit_case(library_, frozen, "Mia"));
  EXPECT_EQ(titles(choices(Role::mentor)), Titles{}) << "not while it is reviewed";
}

TEST_F(ChoicesTest, OutOfACurriculumOnlyThePersonsOwnAttemptsCount) {
  const std::string one = published("One"), two = published("Two");
  attempt_on(one, false);
  attempt_on(one, true);
  attempt_on(two, true);
  case_id_ = one;
  lesion_id_ = list_lesions(library_, one).at(0).lesion_id;
  attempt(user("Ann", Role::trainee), 1.0, 20.0);
  NewAttempt simulated = new_attempt(person_, 1.0, 20.0);
  simulated.operator_name = "expert";
  static_cast<void>(add_attempt(library_, simulated).value());
  const Choices all = choices();
  ASSERT_EQ(titles(all), (Titles{"One", "Two"}));
  EXPECT_EQ(all.cases[0].attempts, 2);
  EXPECT_EQ(all.cases[0].passes, 1);
  EXPECT_TRUE(all.cases[0].open);
  EXPECT_FALSE(all.cases[0].due) << "nothing asks for it";
  EXPECT_EQ(all.cases[0].reached, std::nullopt);
  EXPECT_EQ(all.cases[0].attempts_left, std::nullopt);
  EXPECT_EQ(all.cases[1].passes, 1);
  EXPECT_EQ(next_of(all), nullptr);
}

// Before: with nothing due, a pass led nowhere.
TEST_F(ChoicesTest, APassLeadsOnAndTellsWhatIsMissing) {
  const std::string one = published("One"), two = published("Two"), three = published("Three");
  EXPECT_EQ(choices().cases[0].passes_missing, 2);
  attempt_on(one, true);
  EXPECT_EQ(choices().cases[0].passes_missing, 1);
  EXPECT_EQ(after_pass(choices(), one)->case_id, two);
  EXPECT_EQ(after_pass(choices(), three)->case_id, one) << "round again: one more pass is missing";
  attempt_on(one, false);
  EXPECT_EQ(choices().cases[0].passes_missing, 2) << "running";
  for (int i = 0; i < 2; ++i) attempt_on(one, true);
  EXPECT_EQ(choices().cases[0].passes_missing, 0);
  EXPECT_EQ(after_pass(choices(), three)->case_id, two);
  for (const std::string& id : {two, three, two, three}) attempt_on(id, true);
  EXPECT_EQ(after_pass(choices(), two)->case_id, three) << "all are proficient, and another is better than none";
  EXPECT_EQ(after_pass(choices(), "elsewhere"), nullptr);
  ASSERT_TRUE(publish_curriculum(library_, curriculum("Year", {published("Four")}), "Dan"));
  EXPECT_EQ(after_pass(choices(), two)->title, "Four") << "what is due comes first";
}

TEST_F(ChoicesTest, TheOnlyCaseFollowsItself) {
  const std::string only = published("Only");
  attempt_on(only, true);
  EXPECT_EQ(after_pass(choices(), only)->case_id, only);
}

TEST_F(ChoicesTest, WhatIsPublishedToACohortReachesNobodyElse) {
  const std::string alone = published("Alone"), item = published("In a curriculum");
  ASSERT_TRUE(publish_curriculum(library_, curriculum("Year", {item}), "Dan"));
  const std::string ann = user("Ann", Role::trainee);
  EXPECT_EQ(titles(choices()), (Titles{"Year: In a curriculum", "Alone"}));
  EXPECT_EQ(titles(choices_of(library_, ann, Role::trainee)), Titles{}) << "she was never in the cohort";
  for (const Role role : kAllRoles) EXPECT_EQ(titles(choices_of(library_, ann, role)), Titles{}) << name_of(role);
  const std::string cohort = list_cohorts(library_).at(0).cohort_id;
  ASSERT_TRUE(enrol(library_, cohort, ann, Post::learner));
  EXPECT_EQ(titles(choices_of(library_, ann, Role::trainee)), (Titles{"Year: In a curriculum", "Alone"}));
  ASSERT_TRUE(end_enrolment(library_, cohort, person_));
  EXPECT_EQ(titles(choices()), Titles{}) << "he has left it";
}

TEST_F(ChoicesTest, GatesOpenAndWhatIsDueMovesOn) {
  const std::string alone = published("Alone"), one = published("One"), two = published("Two");
  const std::string id = curriculum("Year", {one, two});
  EXPECT_EQ(titles(choices()), (Titles{"Alone", "One", "Two"})) << "a curriculum in the making leads nobody";
  ASSERT_TRUE(publish_curriculum(library_, id, "Dan"));
  Choices all = choices();
  ASSERT_EQ(titles(all), (Titles{"Year: One", "Year: Two", "Alone"}));
  EXPECT_TRUE(all.cases[0].open && all.cases[0].due);
  EXPECT_EQ(all.cases[0].reached, Proficiency::not_started);
  EXPECT_FALSE(all.cases[1].open || all.cases[1].due);
  ASSERT_NE(next_of(all), nullptr);
  EXPECT_EQ(next_of(all)->case_id, one);
  attempt_on(one, false);
  EXPECT_FALSE(choices().cases[1].open) << "practised is not passed";
  attempt_on(one, true);
  all = choices();
  EXPECT_TRUE(all.cases[1].open);
  EXPECT_EQ(all.cases[0].attempts, 2);
  EXPECT_EQ(all.cases[0].passes, 1);
  EXPECT_EQ(all.cases[0].reached, Proficiency::passed);
  EXPECT_EQ(next_of(all)->case_id, one) << "passed is not proficient";
  attempt_on(one, true);
  EXPECT_EQ(choices().cases[0].reached, Proficiency::proficient);
  EXPECT_EQ(next_of(choices())->case_id, two);
  attempt_on(two, true);
  attempt_on(two, true);
  EXPECT_EQ(next_of(choices()), nullptr) << "all is learnt";
  EXPECT_TRUE(choices().cases[1].open) << "and may be practised";
  ASSERT_TRUE(remove_curriculum(library_, id, "Dan"));
  EXPECT_EQ(titles(choices()), (Titles{"Alone", "One", "Two"})) << "a retired one leads nobody";
}

// Was: the mentor had to pass five cases to show a class the sixth.
TEST_F(ChoicesTest, AMentorOpensEveryCaseOfACurriculum) {
  const std::string one = published("One"), two = published("Two");
  ASSERT_TRUE(publish_curriculum(library_, curriculum("Course", {one, two}), "Dan"));
  for (const Role role : {Role::trainee, Role::researcher, Role::director, Role::admin}) {
    EXPECT_TRUE(choices(role).cases[0].open) << name_of(role);
    EXPECT_FALSE(choices(role).cases[1].open) << name_of(role);
  }
  EXPECT_TRUE(choices(Role::mentor).cases[0].open);
  EXPECT_TRUE(choices(Role::mentor).cases[1].open);
}

TEST_F(ChoicesTest, AttemptsAreUsedUp) {
  const std::string one = published("One", 9), two = published("Two", 1);
  ASSERT_TRUE(publish_curriculum(library_, curriculum("Year", {one}, 2), "Dan"));
  ASSERT_TRUE(publish_curriculum(library_, curriculum("Extra", {two}), "Dan"));
  EXPECT_EQ(choices().cases[0].attempts_left, 2) << "the item's limit, not the case's";
  EXPECT_EQ(choices().cases[1].attempts_left, 1) << "the case's own";
  attempt_on(one, false);
  EXPECT_TRUE(choices().cases[0].open && choices().cases[0].due);
  attempt_on(one, false);
  const Choices all = choices();
  EXPECT_EQ(all.cases[0].attempts_left, 0);
  EXPECT_FALSE(all.cases[0].open);
  ASSERT_NE(next_of(all), nullptr);
  EXPECT_EQ(next_of(all)->curriculum, "Extra");
  attempt_on(two, false);
  EXPECT_EQ(next_of(choices()), nullptr);
  EXPECT_EQ(titles(choices()), (Titles{"Year: One", "Extra: Two"})) << "they stay in sight";
}

TEST_F(ChoicesTest, ACaseOfTwoCurriculaIsInBothAndANewVersionTakesItsPlace) {
  const std::string first = published("One");
  ASSERT_TRUE(publish_curriculum(library_, curriculum("Year", {first}), "Dan"));
  ASSERT_TRUE(publish_curriculum(library_, curriculum("Extra", {first}), "Dan"));
  EXPECT_EQ(titles(choices()), (Titles{"Year: One", "Extra: One"}));
  const std::string second = new_version(library_, first, "Mia").value();
  EXPECT_EQ(choices().cases[0].case_id, first) << "a draft is nobody's case";
  publish(second);
  const Choices all = choices();
  ASSERT_EQ(titles(all), (Titles{"Year: One", "Extra: One"})) << "the first, though not retired, is out of sight";
  EXPECT_EQ(all.cases[0].case_id, second);
  ASSERT_TRUE(retire_case(library_, second, "Mia"));
  EXPECT_EQ(titles(choices()), (Titles{"Year: One", "Extra: One"})) << "the first is there again";
  EXPECT_EQ(choices().cases[0].case_id, first);
  ASSERT_TRUE(retire_case(library_, first, "Mia"));
  EXPECT_EQ(titles(choices()), Titles{}) << "an item without a case cannot be chosen";
}

// Before: both stood in the list under one title.
TEST_F(ChoicesTest, OfFreePracticeTheNewestVersionThatReachesSomebodyIsListed) {
  const std::string first = published("One");
  library_.database().run("DROP TRIGGER training_case_published_keeps_its_name");
  library_.database().run("UPDATE training_case SET audience = 'everyone' WHERE state = 'published'");
  published("Two");
  const std::string second = new_version(library_, first, "Mia").value();
  EXPECT_EQ(choices().cases.at(0).case_id, first) << "a draft replaces nothing";
  publish(second);  // for Mia's cohort
  ASSERT_EQ(titles(choices()), (Titles{"One", "Two"})) << "in the first's place";
  EXPECT_EQ(choices().cases[0].case_id, second);
  const Choices elsewhere = choices_of(library_, user("Ann", Role::trainee), Role::trainee);
  ASSERT_EQ(elsewhere.cases.size(), 1U);
  EXPECT_EQ(elsewhere.cases[0].case_id, first) << "the second never reached her";
}

// Before: for Eve the item was gone and its case open as free practice, though the first is not passed.
TEST_F(ChoicesTest, AGateHoldsWhicheverVersionReachesSomebody) {
  const std::string one = published("One"), two = published("Two");
  library_.database().run("DROP TRIGGER training_case_published_keeps_its_name");
  library_.database().run("UPDATE training_case SET audience = 'everyone' WHERE state = 'published'");
  ASSERT_TRUE(publish_curriculum(library_, curriculum("Year", {one, two}), "Dan"));
  const std::string next = new_version(library_, two, "Mia").value();
  ASSERT_TRUE(set_title(library_, next, "Two for Mia's"));
  publish(next);
  EXPECT_EQ(choices().cases[1].case_id, next);
  const Choices others = choices_of(library_, user("Eve", Role::trainee), Role::trainee);
  ASSERT_EQ(titles(others), (Titles{"Year: One", "Year: Two"}));
  EXPECT_FALSE(others.cases[1].open);
}

}  // namespace
}  // namespace seldinger::casedb
