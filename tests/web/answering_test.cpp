// A questionnaire answered on pages, over a real library: by many at once, on a shared device, by a browser that
// dies, and by whoever types what is wrong.
#include "web/routes/answering.h"

#include <gmock/gmock.h>

#include <atomic>
#include <map>
#include <set>
#include <thread>

#include "assessment/questionnaire/shipped_forms.h"
#include "casedb/questionnaires/responses.h"
#include "reports/pages/answer_pages.h"
#include "tests/fixtures/folders.h"
#include "tests/web/fake_site.h"
#include "web/library_questions.h"

namespace seldinger::web {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
namespace questionnaire = assessment::questionnaire;

const questionnaire::Form& asked_form() {
  return questionnaire::find_shipped_form("workshop-2007")->form;
}

class AnsweringTest : public testing::Test {
 protected:
  std::filesystem::path folder_ = fixtures::fresh_test_folder("web") / "library";
  std::string code_;
  std::unique_ptr<Questions> questions_;
  FakeSite world_;
  std::optional<Site> site_;

  void SetUp() override {
    auto library = std::move(casedb::Library::open_or_create(folder_).value());
    ASSERT_TRUE(casedb::store_form(library, std::string(questionnaire::find_shipped_form("workshop-2007")->json)));
    code_ = casedb::open_round(library, {"Study <day>", "workshop-2007", 0, {}, {"trainee", "expert"}})->code;
    questions_ = std::move(questions_of(std::move(library)).value());
    site_.emplace(*questions_, world_.surroundings, routes());
  }
  Response begin(FakeBrowser& browser, const std::string& respondent, const std::string& group = "expert") {
    const std::string token = form_token(browser.get("/answer?code=" + code_).body, "/answer");
    return browser.post("/answer", "code=" + code_ + "&begin=yes&respondent=" + respondent + "&group=" + group +
                                       "&language=&token=" + token);
  }
  Response keep(FakeBrowser& browser, std::size_t section, const std::string& fields, const char* go = "next") {
    const std::string number = std::to_string(section);
    const std::string token = form_token(browser.get("/answer/form?section=" + number).body, "/answer/form");
    return browser.post("/answer/form", "section=" + number + "&go=" + go + "&token=" + token +
                                            (fields.empty() ? "" : "&" + fields));
  }
  casedb::Responses stored() {
    auto library = casedb::Library::open(folder_);
    return *casedb::list_responses(*library, code_);
  }
  // What the person of that number answers to an item: every state, and every point of its scale.
  static std::string answer_of(std::size_t person, const questionnaire::Item& item) {
    const std::size_t turn = person * 7 + item.id.size() + static_cast<std::size_t>(item.id.back());
    if (item.kind == questionnaire::ItemKind::comment)
      return turn % 3 == 0 ? "" : "person " + std::to_string(person);
    if (turn % 5 == 0) return "";
    if (item.not_applicable && turn % 5 == 1) return "n/a";
    if (item.kind == questionnaire::ItemKind::choice) return item.choices[turn % item.choices.size()];
    if (item.kind == questionnaire::ItemKind::number)
      return std::to_string(static_cast<int>(item.least) + static_cast<int>(turn % 40));
    const questionnaire::Scale& scale = *asked_form().find_scale(item.scale);
    return std::to_string(scale.points[turn % scale.points.size()].value);
  }
  static std::string fields_of(std::size_t person, const std::vector<const questionnaire::Item*>& items) {
    std::string fields;
    for (const questionnaire::Item* item : items) {
      std::string typed = answer_of(person, *item), field = reports::field_of(*item);
      if (item->kind == questionnaire::ItemKind::number && typed == "n/a") field += "-none", typed = "yes";
      for (char& c : typed)
        if (c == ' ') c = '+';
      const std::size_t slash = typed.find('/');
      if (slash != typed.npos) typed.replace(slash, 1, "%2F");
      fields += (fields.empty() ? "" : "&") + field + "=" + typed;
    }
    return fields;
  }
};

TEST_F(AnsweringTest, TwoHundredByTwentyBrowsersAtOnce) {
  constexpr std::size_t kBrowsers = 20, kEach = 10;
  std::atomic<int> failures = 0;
  const auto sections = assessment::questionnaire::sections_of(asked_form());
  std::vector<std::thread> threads;
  for (std::size_t b = 0; b < kBrowsers; ++b)
    threads.emplace_back([&, b] {
      FakeBrowser browser(*site_);
      browser.from = "127.0.0." + std::to_string(b + 1);
      for (std::size_t i = 0; i < kEach; ++i) {
        const std::size_t person = b * kEach + i;
        failures +=
            begin(browser, "R" + std::to_string(person), person % 2 == 0 ? "expert" : "trainee").status != 303;
        for (std::size_t s = 0; s < sections.size(); ++s)
          failures += keep(browser, s + 1, fields_of(person, sections[s])).status != 303;
        const Response sent = keep(browser, sections.size() + 1, "", "send");
        failures += header_of(sent, "Location") != "/answer/thanks";
        // Sent twice, as impatient fingers do.
        failures += keep(browser, sections.size() + 1, "", "send").status == 200;
      }
    });
  for (std::thread& one : threads) one.join();
  EXPECT_EQ(failures, 0);
  const casedb::Responses all = stored();
  ASSERT_EQ(all.sets.size(), kBrowsers * kEach) << "none lost";
  std::set<std::string> respondents;
  std::map<questionnaire::AnswerState, int> states;
  for (const auto& [id, set] : all.sets) {
    respondents.insert(set.respondent);
    const std::size_t person = std::stoul(set.respondent.substr(1));
    EXPECT_EQ(set.group, person % 2 == 0 ? "expert" : "trainee");
    ASSERT_EQ(set.answers.size(), asked_form().items.size());
    for (const questionnaire::Item& item : asked_form().items) {
      const auto expected = questionnaire::answer_from_text(asked_form(), item, answer_of(person, item));
      ASSERT_TRUE(expected.has_value()) << item.id << " " << answer_of(person, item);
      EXPECT_EQ(set.answers.at(item.id), *expected) << set.respondent << " " << item.id;
      ++states[expected->state];
    }
  }
  EXPECT_EQ(respondents.size(), kBrowsers * kEach) << "none doubled";
  for (const auto state : {questionnaire::AnswerState::missing, questionnaire::AnswerState::not_applicable,
                           questionnaire::AnswerState::answered})
    EXPECT_GT(states[state], 100);
}

TEST_F(AnsweringTest, ABrowserThatDiesGoesOnWhereItWas) {
  FakeBrowser browser(*site_);
  ASSERT_EQ(begin(browser, "A1").status, 303);
  ASSERT_EQ(keep(browser, 1, "item-1=consultant&item-3=44").status, 303);
  // The server starts anew as well: its tokens are others, the draft is there.
  site_.emplace(*questions_, world_.surroundings, routes());
  FakeBrowser again(*site_);
  again.cookies = browser.cookies;
  EXPECT_THAT(again.get("/answer").body, HasSubstr("begun on this device"));
  const std::string page = again.get("/answer/form").body;
  EXPECT_THAT(page, HasSubstr("value=\"consultant\" checked"));
  EXPECT_THAT(page, HasSubstr("value=\"44\""));
  EXPECT_EQ(keep(again, 8, "", "send").status, 303);
  ASSERT_EQ(stored().sets.size(), 1U);
  EXPECT_EQ(stored().sets[0].second.answers.at("3").value, 44.0);
}

// As the page's script sends it, in the middle of a section and of a word.
TEST_F(AnsweringTest, WhatIsTypedIsKeptBeforeASectionIsFinished) {
  FakeBrowser browser(*site_);
  ASSERT_EQ(begin(browser, "A1").status, 303);
  EXPECT_THAT(browser.get("/answer/form").body, HasSubstr("data-keeps"));
  EXPECT_EQ(keep(browser, 1, "item-1=consultant&item-3=44", "keep").status, 204);
  EXPECT_EQ(keep(browser, 1, "item-1=consultant&item-3=4000", "keep").status, 204) << "what does not fit waits";
  FakeBrowser again(*site_);  // the first one died
  again.cookies = browser.cookies;
  const std::string page = again.get("/answer/form").body;
  EXPECT_THAT(page, HasSubstr("value=\"consultant\" checked"));
  EXPECT_THAT(page, HasSubstr("value=\"44\""));
  EXPECT_EQ(browser.post("/answer/form", "section=1&go=keep&token=x").status, 403);
  EXPECT_TRUE(stored().sets.empty()) << "nothing is sent by that";
  EXPECT_EQ(keep(again, 8, "", "send").status, 303);
  EXPECT_EQ(stored().sets[0].second.answers.at("3").value, 44.0);
  EXPECT_EQ(browser.post("/answer/form", "section=1&go=keep&token=x").status, 403);
}

TEST_F(AnsweringTest, TheNextPersonAtAKioskSeesNothingOfTheLast) {
  FakeBrowser browser(*site_);
  ASSERT_EQ(begin(browser, "A1").status, 303);
  ASSERT_EQ(keep(browser, 7, "item-9=my+secret").status, 303);
  ASSERT_EQ(header_of(keep(browser, 8, "", "send"), "Location"), "/answer/thanks");
  EXPECT_EQ(header_of(browser.get("/answer/form"), "Location"), "/answer");
  EXPECT_THAT(browser.get("/answer").body, Not(HasSubstr("begun")));
  ASSERT_EQ(begin(browser, "A2").status, 303);
  for (int section = 1; section <= 8; ++section)
    EXPECT_THAT(browser.get("/answer/form?section=" + std::to_string(section)).body, Not(HasSubstr("my secret")));
  FakeBrowser other(*site_);
  EXPECT_EQ(header_of(other.get("/answer/form"), "Location"), "/answer") << "another browser has no draft";
}

TEST_F(AnsweringTest, WhatDoesNotFitIsSaidAndNothingIsKept) {
  FakeBrowser browser(*site_);
  EXPECT_THAT(browser.get("/answer?code=XXXXXX").body, HasSubstr("No questionnaire has that code"));
  EXPECT_THAT(browser.get("/answer?code=" + code_).body, HasSubstr("Study &lt;day&gt;"));
  const Response nobody = begin(browser, "A1", "");
  EXPECT_EQ(nobody.status, 400);
  EXPECT_THAT(nobody.body, HasSubstr("what you are here as"));
  ASSERT_EQ(begin(browser, "A1").status, 303);
  EXPECT_EQ(begin(browser, "A1").status, 400) << "one code, one person";
  FakeBrowser good(*site_);
  ASSERT_EQ(begin(good, "A2").status, 303);
  const Response refused = keep(good, 1, "item-3=seventeen&item-4=3");
  EXPECT_EQ(refused.status, 400);
  EXPECT_THAT(refused.body, HasSubstr("whole number from 18 to 99"));
  EXPECT_THAT(refused.body, HasSubstr("value=\"seventeen\"")) << "what was typed stays to be mended";
  EXPECT_THAT(good.get("/answer/form?section=1").body, Not(HasSubstr("value=\"3\"")));
  EXPECT_EQ(good.post("/answer/form", "section=1&go=next&item-3=44").status, 403) << "no token";
  Request foreign = good.request("POST", "/answer/form");
  foreign.headers["sec-fetch-site"] = "cross-site";
  EXPECT_EQ(good.send(foreign).status, 403);
  EXPECT_THAT(good.get("/answer/form?section=99").body, HasSubstr("Ready to send?"));
  EXPECT_THAT(good.get("/answer/form?section=0").body, HasSubstr("1 of "));
}

}  // namespace
}  // namespace seldinger::web
