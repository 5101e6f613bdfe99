// Questionnaires in a library: a version stays as it was stored and is never mixed with another, a draft outlives
// its browser, and what was sent stays.
#include <regex>

#include "assessment/questionnaire/shipped_forms.h"
#include "casedb/database/sqlite.h"
#include "casedb/questionnaires/responses.h"
#include "tests/casedb/library_samples.h"

namespace seldinger::casedb {
namespace {

namespace questionnaire = assessment::questionnaire;
using questionnaire::AnswerState;

template <typename T>
std::string code_of(const base::Result<T>& result) {
  return result ? "none" : result.error().code;
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, text.npos) << from;
  return text.replace(at, from.size(), to);
}

class QuestionnairesTest : public testing::Test {
 protected:
  Library library_ = open_library(fresh_folder() / "library");
  const std::string json_{questionnaire::find_shipped_form("workshop-2007")->json};

  Round open(const std::vector<std::string>& groups = {}) {
    EXPECT_TRUE(store_form(library_, json_));
    auto round = open_round(library_, {"Study day", "workshop-2007", 0, {}, groups});
    EXPECT_TRUE(round.has_value());
    return *round;
  }
  bool database_refuses(const std::string& sql) {
    return refused_by_constraint([&] { library_.database().run(sql); });
  }
};

TEST_F(QuestionnairesTest, AVersionIsStoredOnceAndForGood) {
  const auto stored = store_form(library_, json_);
  ASSERT_TRUE(stored.has_value());
  EXPECT_EQ(stored->body, questionnaire::canonical_json(questionnaire::find_shipped_form("workshop-2007")->form));
  EXPECT_EQ(store_form(library_, json_)->questionnaire_id, stored->questionnaire_id)
      << "the same words are the same";
  EXPECT_EQ(code_of(store_form(library_, replaced(json_, "Your age", "Age"))), "form_taken");
  EXPECT_EQ(code_of(store_form(library_, "{}")), "bad_form");
  EXPECT_TRUE(
      store_form(library_, replaced(replaced(json_, "Your age", "Age"), "\"version\": 1", "\"version\": 2")));
  EXPECT_EQ(list_forms(library_).size(), 2U);
  EXPECT_EQ(find_forms(library_, "workshop-2007")->front().form.version, 2) << "the newest";
  EXPECT_EQ(find_forms(library_, "workshop-2007", 1)->front().body_hash, stored->body_hash);
  EXPECT_EQ(code_of(find_forms(library_, "workshop-2007", 3)), "no_form");
  EXPECT_TRUE(database_refuses("UPDATE questionnaire SET version = 7"));
  EXPECT_TRUE(database_refuses("DELETE FROM questionnaire"));
}

TEST_F(QuestionnairesTest, ATranslationAsksTheSame) {
  ASSERT_TRUE(store_form(library_, json_));
  const std::string french =
      replaced(replaced(json_, "\"language\": \"en\"", "\"language\": \"fr\""), "Your age", "Votre âge");
  EXPECT_EQ(code_of(store_form(library_, replaced(french, "\"most\": 99", "\"most\": 98"))), "form_differs");
  ASSERT_TRUE(store_form(library_, french));
  const Round round = open();
  const auto secret = begin_response(library_, round.code, {"F1", "", "fr"});
  EXPECT_EQ(find_draft(library_, *secret)->form.form.find_item("3")->text, "Votre âge");
  const auto other = begin_response(library_, round.code, {"E1", "", "nl"});
  EXPECT_EQ(find_draft(library_, *other)->form.form.language, "en") << "what there is not is asked in the first";
}

TEST_F(QuestionnairesTest, ARoundHasACodeThatCanBeReadAloud) {
  const Round round = open({"trainee", "expert"});
  EXPECT_TRUE(std::regex_match(round.code, std::regex("[ACDEFGHJKLMNPQRTUVWXY34679]{6}"))) << round.code;
  std::string typed = round.code.substr(0, 3) + " " + round.code.substr(3);
  for (char& c : typed) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  EXPECT_EQ(find_round(library_, typed)->round_id, round.round_id);
  EXPECT_EQ(round.groups, (std::vector<std::string>{"trainee", "expert"}));
  EXPECT_EQ(code_of(find_round(library_, "SSSSSS")), "no_round");
  EXPECT_EQ(code_of(open_round(library_, {"Day", "workshop-2007", 0, {}, {"one"}})), "bad_group");
  EXPECT_EQ(code_of(open_round(library_, {"Day", "workshop-2007", 0, {}, {"a", "a"}})), "bad_group");
  EXPECT_EQ(code_of(open_round(library_, {"", "workshop-2007"})), "bad_title");
  EXPECT_EQ(code_of(open_round(library_, {"Day", "none"})), "no_form");
}

TEST_F(QuestionnairesTest, ADraftOutlivesItsBrowserAndIsSentOnce) {
  const Round round = open({"trainee", "expert"});
  EXPECT_EQ(code_of(begin_response(library_, round.code, {"A1", "mentor", ""})), "bad_group");
  EXPECT_EQ(code_of(begin_response(library_, round.code, {"A1", "", ""})), "bad_group");
  EXPECT_EQ(code_of(begin_response(library_, round.code, {"<b>", "expert", ""})), "bad_respondent");
  EXPECT_EQ(code_of(begin_response(library_, "XXXXXX", {"A1", "expert", ""})), "no_round");
  const auto secret = begin_response(library_, round.code, {"A1", "expert", ""});
  ASSERT_TRUE(secret.has_value());
  EXPECT_EQ(code_of(begin_response(library_, round.code, {"A1", "trainee", ""})), "respondent_taken");
  ASSERT_TRUE(save_draft(library_, *secret, {{"7", "3"}, {"6a", "n/a"}, {"9", "Well done"}}));
  EXPECT_EQ(code_of(save_draft(library_, *secret, {{"7", "4"}, {"8a", "6"}})), "bad_answer");
  EXPECT_EQ(code_of(save_draft(library_, *secret, {{"10", "4"}})), "bad_answer");
  EXPECT_EQ(code_of(save_draft(library_, std::string(64, '0'), {{"7", "4"}})), "no_draft");

  // Another process, another day.
  {
    auto later = Library::open(library_.folder());
    const auto draft = find_draft(*later, *secret);
    ASSERT_TRUE(draft.has_value());
    EXPECT_EQ(draft->set.answers.at("7").value, 3.0) << "what was refused changed nothing";
    EXPECT_EQ(draft->set.answers.at("6a").state, AnswerState::not_applicable);
  }
  ASSERT_TRUE(save_draft(library_, *secret, {{"7", ""}, {"8a", "5"}}));
  EXPECT_TRUE(list_responses(library_, round.code)->sets.empty()) << "a draft is not told";
  ASSERT_TRUE(submit_draft(library_, *secret));
  EXPECT_EQ(code_of(submit_draft(library_, *secret)), "no_draft");
  EXPECT_EQ(code_of(save_draft(library_, *secret, {{"8a", "1"}})), "no_draft");

  const auto responses = list_responses(library_, round.code);
  ASSERT_EQ(responses->sets.size(), 1U);
  const ResponseSet& set = responses->sets[0].second;
  EXPECT_EQ(set.answers.size(), 17U) << "every item, answered or not";
  EXPECT_EQ(set.answers.at("7").state, AnswerState::missing) << "taken back";
  EXPECT_EQ(set.answers.at("8a").value, 5.0);
  EXPECT_EQ(set.answers.at("8b").state, AnswerState::missing);
  EXPECT_EQ(set.answers.at("6a").state, AnswerState::not_applicable);
  EXPECT_EQ(set.answers.at("9").text, "Well done");
  EXPECT_EQ(set.group, "expert");
  for (const char* sql :
       {"UPDATE response SET value = 1 WHERE item_id = '8a'", "UPDATE response_set SET group_name = ''",
        "INSERT INTO response SELECT response_id, 'x', 'missing', NULL, '' FROM response_set"})
    EXPECT_TRUE(database_refuses(sql)) << sql;
}

TEST_F(QuestionnairesTest, AnswersAreOfTheVersionThatTheRoundAsks) {
  const Round first = open();
  ASSERT_TRUE(store_form(library_, replaced(json_, "\"version\": 1", "\"version\": 2")));
  const Round second = *open_round(library_, {"Next year", "workshop-2007"});
  EXPECT_EQ(second.version, 2);
  const auto secret = begin_response(library_, first.code, {"A1", "", ""});
  EXPECT_EQ(find_draft(library_, *secret)->form.form.version, 1);
  ASSERT_TRUE(submit_draft(library_, *secret));
  EXPECT_EQ(list_responses(library_, first.code)->sets.size(), 1U);
  EXPECT_TRUE(list_responses(library_, second.code)->sets.empty());
  const std::string newer = find_forms(library_, "workshop-2007", 2)->front().questionnaire_id;
  EXPECT_TRUE(
      database_refuses("INSERT INTO response_set (response_id, round_id, questionnaire_id, respondent, "
                       "group_name, source, begun_us) VALUES ('r', '" +
                       first.round_id + "', '" + newer + "', 'B1', '', 'paper', 1)"))
      << "the database itself mixes no versions";
}

TEST_F(QuestionnairesTest, AClosedRoundTakesNothing) {
  const Round round = open();
  const auto secret = begin_response(library_, round.code, {});
  ASSERT_TRUE(secret.has_value());
  EXPECT_EQ(find_draft(library_, *secret)->set.respondent.size(), 6U) << "a code is drawn";
  ASSERT_TRUE(close_round(library_, round.round_id));
  EXPECT_EQ(code_of(close_round(library_, round.round_id)), "round_closed");
  EXPECT_EQ(code_of(save_draft(library_, *secret, {{"7", "3"}})), "round_closed");
  EXPECT_EQ(code_of(submit_draft(library_, *secret)), "round_closed");
  EXPECT_EQ(code_of(begin_response(library_, round.code, {})), "round_closed");
  EXPECT_EQ(code_of(add_paper_forms(library_, round.code, {{{"P1", "", ""}, {}}})), "round_closed");
}

// Was: whoever had a code, which needs no account, could fill the disk.
TEST_F(QuestionnairesTest, ARoundTakesTwoThousandOnPages) {
  const Round round = open();
  ASSERT_TRUE(begin_response(library_, round.code, {}));
  library_.database().run(
      "WITH RECURSIVE number(n) AS (SELECT 1 UNION ALL SELECT n + 1 FROM number WHERE n < " +
      std::to_string(kMostBegunOnPages - 2) +
      ") INSERT INTO response_set SELECT printf('many-%d', n), round_id, questionnaire_id, printf('many-%d', n), "
      "group_name, source, NULL, begun_us, NULL, 0 FROM number, response_set");
  ASSERT_TRUE(begin_response(library_, round.code, {}));
  EXPECT_EQ(code_of(begin_response(library_, round.code, {})), "round_full");
}

TEST_F(QuestionnairesTest, PaperIsTakenWholeOrNotAtAll) {
  const Round round = open({"trainee", "expert"});
  const std::vector<PaperForm> good = {{{"P1", "expert", ""}, {{"7", "3"}, {"8a", "n/a"}}},
                                       {{"P2", "trainee", ""}, {{"7", ""}, {"4", "7,5"}}}};
  std::vector<PaperForm> bad = good;
  bad[1].typed["7"] = "9";
  bad.push_back({{"", "expert", ""}, {}});
  const auto refused = add_paper_forms(library_, round.code, bad);
  EXPECT_EQ(code_of(refused), "bad_answers");
  EXPECT_EQ(refused.error().findings.size(), 2U);
  EXPECT_TRUE(list_responses(library_, round.code)->sets.empty());
  EXPECT_EQ(*add_paper_forms(library_, round.code, good), 2U);
  EXPECT_EQ(code_of(add_paper_forms(library_, round.code, good)), "bad_answers") << "typed again";
  const auto responses = list_responses(library_, round.code);
  ASSERT_EQ(responses->sets.size(), 2U);
  EXPECT_EQ(responses->sets[0].second.answers.at("8a").state, AnswerState::not_applicable);
  EXPECT_EQ(responses->sets[1].second.answers.at("4").value, 7.5);
  EXPECT_EQ(responses->sets[1].second.source, "paper");
}

}  // namespace
}  // namespace seldinger::casedb
