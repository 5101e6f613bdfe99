// Questionnaires at the workstation: after an attempt, once, by who consents; a draft goes on after the program
// died, and with a person go their answers.
#include "casedb/questionnaires/desk_rounds.h"

#include "assessment/questionnaire/shipped_forms.h"
#include "casedb/database/sqlite.h"
#include "casedb/keeping/erase.h"
#include "casedb/people/consent.h"
#include "casedb/people/people.h"
#include "casedb/questionnaires/responses.h"
#include "tests/casedb/library_samples.h"

namespace seldinger::casedb {
namespace {

class DeskRoundsTest : public testing::Test {
 protected:
  Library library_ = open_library(fresh_folder() / "library");
  std::string case_id_ = add_case(library_, sample_case());
  std::string lesion_id_ = add_lesion(library_, case_id_, sample_lesion()).value();
  std::string zoe_ = add_user(library_, "Zoe", Role::trainee, "a password").value();
  std::string tim_ = add_user(library_, "Tim", Role::trainee, "a password").value();

  Round open(const std::optional<std::string>& study = {}) {
    EXPECT_TRUE(
        store_form(library_, std::string(assessment::questionnaire::find_shipped_form("workshop-2007")->json)));
    return open_round(library_,
                      {.title = "After each day", .form_id = "workshop-2007", .study_id = study, .at_desk = true})
        .value();
  }
  void attempt_by(const std::string& person_id, std::int64_t started_us, const char* operator_name = "person") {
    NewAttempt made = sample_attempt(case_id_, lesion_id_);
    made.person_id = person_id;
    made.operator_name = operator_name;
    made.started_us = started_us;
    made.recording = sample_recording(100, static_cast<std::uint64_t>(started_us));
    ASSERT_TRUE(add_attempt(library_, made));
  }
  template <typename T>
  static std::string code_of(const base::Result<T>& result) {
    return result ? "none" : result.error().code;
  }
  std::int64_t count(const std::string& table) {
    return library_.database().integer("SELECT count(*) FROM " + table);
  }
};

TEST_F(DeskRoundsTest, ItIsDueAfterAnAttemptAndOnce) {
  const Round round = open();
  EXPECT_TRUE(round.at_desk);
  const std::int64_t before_us = round.opened_us - 1'000'000, after_us = round.opened_us + 1'000'000;
  attempt_by(zoe_, before_us);
  attempt_by(zoe_, after_us, "novice");
  EXPECT_TRUE(due_at_desk(library_, zoe_).empty()) << "before it was opened, or simulated in her name";
  EXPECT_EQ(code_of(answer_at_desk(library_, round.round_id, zoe_)), "not_due");
  attempt_by(zoe_, after_us + 1);
  ASSERT_EQ(due_at_desk(library_, zoe_).size(), 1U);
  EXPECT_TRUE(due_at_desk(library_, tim_).empty());

  const auto first = answer_at_desk(library_, round.round_id, zoe_);
  ASSERT_TRUE(first.has_value());
  ASSERT_TRUE(save_draft(library_, *first, {{"7", "3"}, {"9", "half a"}}));
  const auto later = answer_at_desk(library_, round.round_id, zoe_);
  ASSERT_TRUE(later.has_value());
  EXPECT_EQ(code_of(find_draft(library_, *first)), "no_draft") << "another program has it now";
  EXPECT_EQ(find_draft(library_, *later)->set.answers.at("9").text, "half a");
  EXPECT_EQ(count("response_set"), 1);
  ASSERT_TRUE(submit_draft(library_, *later));
  EXPECT_TRUE(due_at_desk(library_, zoe_).empty());
  EXPECT_EQ(code_of(answer_at_desk(library_, round.round_id, zoe_)), "not_due") << "none is doubled";

  const Responses told = list_responses(library_, round.code).value();
  ASSERT_EQ(told.sets.size(), 1U);
  EXPECT_EQ(told.sets[0].second.source, "window");
  EXPECT_EQ(told.sets[0].second.respondent.size(), 6U) << "a drawn code: nobody who reads it learns whose it is";
  EXPECT_EQ(told.sets[0].second.answers.size(), 17U);
}

TEST_F(DeskRoundsTest, NobodyElseAnswersIt) {
  const Round round = open();
  attempt_by(zoe_, round.opened_us + 1);
  EXPECT_EQ(code_of(begin_response(library_, round.code, {})), "desk_round");
  EXPECT_EQ(code_of(add_paper_forms(library_, round.code, {{{"P1", "", ""}, {}}})), "desk_round");
  EXPECT_EQ(code_of(open_round(
                library_, {.title = "Day", .form_id = "workshop-2007", .groups = {"a", "b"}, .at_desk = true})),
            "bad_group");
  ASSERT_TRUE(close_round(library_, round.round_id));
  EXPECT_TRUE(due_at_desk(library_, zoe_).empty());
}

TEST_F(DeskRoundsTest, AStudysIsAskedOfWhoConsentsAndGoesWithTheConsent) {
  const std::string study = add_study(library_, "Needles").value();
  ASSERT_TRUE(add_consent_text(library_, study, "May we?"));
  const Round round = open(study);
  attempt_by(zoe_, round.opened_us + 1);
  EXPECT_TRUE(due_at_desk(library_, zoe_).empty()) << "she has not consented";
  const std::string text_id = list_consents(library_, zoe_)[0].text_id;
  ASSERT_TRUE(give_consent(library_, zoe_, text_id));
  const auto secret = answer_at_desk(library_, round.round_id, zoe_);
  ASSERT_TRUE(secret.has_value());
  ASSERT_TRUE(submit_draft(library_, *secret));
  const Responses told = list_responses(library_, round.code).value();
  ASSERT_EQ(told.sets.size(), 1U);
  EXPECT_TRUE(told.sets[0].second.respondent.starts_with("P-")) << "as the study's other exports call her";
  ASSERT_TRUE(withdraw_consent(library_, zoe_, text_id));
  EXPECT_TRUE(list_responses(library_, round.code)->sets.empty());
}

TEST_F(DeskRoundsTest, WithAPersonGoTheirAnswers) {
  const Round round = open();
  for (const std::string& person : {zoe_, tim_}) {
    attempt_by(person, round.opened_us + 1);
    const auto secret = answer_at_desk(library_, round.round_id, person);
    ASSERT_TRUE(save_draft(library_, *secret, {{"9", person == zoe_ ? "of Zoe" : "of Tim"}}));
    ASSERT_TRUE(submit_draft(library_, *secret));
  }
  for (const char* sql :
       {"UPDATE desk_response SET person_id = (SELECT max(person_id) FROM person)", "DELETE FROM desk_response"})
    EXPECT_TRUE(refused_by_constraint([&] { library_.database().run(sql); })) << sql;
  ASSERT_TRUE(erase_person(library_, "Zoe", {}));
  EXPECT_EQ(count("desk_response"), 1);
  EXPECT_EQ(count("response_set"), 1);
  EXPECT_EQ(count("response WHERE body = 'of Zoe'"), 0);
  EXPECT_EQ(count("response WHERE body = 'of Tim'"), 1);
}

}  // namespace
}  // namespace seldinger::casedb
