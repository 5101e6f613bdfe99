// Replays rated on pages, over a real library: what a rater can fetch tells nothing of who made what, and what is
// typed is kept.

#include <gmock/gmock.h>

#include "assessment/questionnaire/shipped_forms.h"
#include "casedb/people/cohorts.h"
#include "casedb/questionnaires/rounds.h"
#include "casedb/ratings/rating_rounds.h"
#include "tests/casedb/library_samples.h"
#include "tests/web/fake_site.h"
#include "web/library_questions.h"

namespace seldinger::web {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

constexpr const char* kNames[] = {"Zebedee Quagmire", "Ursula Vandeleur"};

// Two people in two groups, three attempts each, rated by two raters; `swapped`: each attempt is the other's.
struct World {
  explicit World(bool swapped, const std::filesystem::path& in = fixtures::fresh_test_folder("web"))
      : folder(in / (swapped ? "swapped" : "as_it_was")) {
    casedb::Library library = casedb::open_library(folder);
    EXPECT_TRUE(
        casedb::store_form(library, std::string(assessment::questionnaire::find_shipped_form("osats-grs")->json)));
    const std::string case_id = casedb::add_case(library, casedb::sample_case("Spleen of Mr. Smith"));
    const std::string lesion_id = casedb::add_lesion(library, case_id, casedb::sample_lesion()).value();
    std::vector<std::string> people;
    for (const char* name : kNames) {
      people.push_back(casedb::add_user(library, name, casedb::Role::trainee, "a password").value());
      const auto cohort = casedb::add_cohort(library, std::string("Group of ") + name, "Radiology", "");
      EXPECT_TRUE(casedb::enrol(library, *cohort, people.back(), casedb::Post::learner));
      secrets.insert(secrets.end(), {name, people.back(), *cohort, std::string("Group of ") + name});
    }
    casedb::NewRatingRound made;
    made.round = {"Replays of the spring", "osats-grs", 0, {}, {}};
    for (std::size_t i = 0; i < 6; ++i) {
      casedb::NewAttempt attempt = casedb::sample_attempt(case_id, lesion_id);
      attempt.person_id = people[(i % 2 == 0) == swapped ? 1 : 0];
      attempt.operator_name = casedb::kPersonOperator;
      attempt.recording = casedb::sample_recording(200, i);
      secrets.push_back(casedb::add_attempt(library, attempt).value());
      made.replays.push_back(
          {secrets.back(), "<section class=\"replay\">needle " + std::to_string(i) + "</section>", {}});
    }
    made.calibration.push_back({secrets.back(), made.replays.back().sheet, {{"tissue", "2"}}});
    made.replays.pop_back();
    made.seed = 5;
    const auto opened = casedb::open_rating_round(library, made);
    code = opened->round.code;
    keys = opened->keys;
    secrets.insert(secrets.end(), {case_id, lesion_id, "Spleen", code, "2023-11-14", "17000000"});
    questions = std::move(questions_of(std::move(library)).value());
    site.emplace(*questions, fake.surroundings, routes());
  }
  // Logged in with a rater's key.
  FakeBrowser rater(std::size_t i) {
    FakeBrowser browser(*site);
    const std::string token = form_token(browser.get("/rate").body, "/rate");
    EXPECT_EQ(header_of(browser.post("/rate", "key=" + keys[i] + "&token=" + token), "Location"), "/rate/bench");
    return browser;
  }
  Response send(FakeBrowser& browser, std::size_t n, const std::string& fields, const char* go = "send") {
    const std::string token = form_token(browser.get("/rate/replay?n=" + std::to_string(n)).body, "/rate/replay");
    return browser.post("/rate/replay", "n=" + std::to_string(n) + "&go=" + go + "&token=" + token + "&" + fields);
  }

  std::filesystem::path folder;
  std::vector<std::string> secrets;  // what no rater may meet
  std::string code;
  std::vector<std::string> keys;
  FakeSite fake;
  std::unique_ptr<Questions> questions;
  std::optional<Site> site;
};

const char* const kAllFives =
    "item-tissue=5&item-time=5&item-handling=5&item-knowledge=5&item-flow=5&item-procedure=n%2Fa&item-comment="
    "fluid";

// Every byte that a rater's browser gets on the way through everything that there is for it, headers and all, but
// for the token that guards its forms.
std::vector<std::string> everything(World& world, std::size_t rater) {
  std::vector<std::string> all;
  const auto note = [&](const Response& response) {
    std::string bytes = bytes_of(response, true);
    for (std::size_t at = bytes.find("name=\"token\" value=\""); at != bytes.npos;
         at = bytes.find("name=\"token\" value=\"", at + 1))
      bytes.replace(at + 20, bytes.find('"', at + 20) - at - 20, "TOKEN");
    all.push_back(bytes.substr(0, bytes.find("Set-Cookie")));
  };
  FakeBrowser browser = world.rater(rater);
  note(browser.get("/rate"));
  for (std::size_t n = 0; n <= 8; ++n) {
    note(browser.get("/rate/bench"));
    note(browser.get("/rate/replay?n=" + std::to_string(n)));
    if (n == 0) continue;
    note(world.send(browser, n, "item-tissue=9"));
    note(world.send(browser, n, kAllFives));
    note(browser.get("/rate/replay?n=" + std::to_string(n)));
  }
  for (const char* path :
       {"/answer.js", "/film.js", "/style.css", "/rate/replay", "/rate/replay?n=x", "/attempts", "/answer"})
    note(browser.get(path));
  return all;
}

TEST(Rating, NothingThatARaterCanFetchTellsWhoMadeWhat) {
  const auto in = fixtures::fresh_test_folder("web");
  World as_it_was(false, in), swapped(true, in);
  for (const std::size_t rater : {0U, 1U}) {
    const auto first = everything(as_it_was, rater), second = everything(swapped, rater);
    ASSERT_EQ(first.size(), second.size());
    for (std::size_t i = 0; i < first.size(); ++i)
      EXPECT_EQ(first[i], second[i]) << "by groups changed, byte for byte";
    for (World* world : {&as_it_was, &swapped})
      for (const std::string& answer : world == &as_it_was ? first : second)
        for (const std::string& secret : world->secrets) EXPECT_THAT(answer, Not(HasSubstr(secret)));
  }
  const auto all = everything(as_it_was, 0);
  EXPECT_THAT(all[3], HasSubstr("needle ")) << "there is something to tell";
}

TEST(Rating, EachRaterHasAnOrderOfTheirOwnAndGoesOnWhereTheyWere) {
  World world(false);
  FakeBrowser first = world.rater(0), second = world.rater(1);
  std::string orders[2];
  for (std::size_t n = 1; n <= 6; ++n) {
    int i = 0;
    for (FakeBrowser* browser : {&first, &second}) {
      const std::string page = browser->get("/rate/replay?n=" + std::to_string(n)).body;
      orders[i++] += page.substr(page.find("needle ") + 7, 1);
    }
  }
  EXPECT_NE(orders[0], orders[1]);
  EXPECT_EQ(orders[0].size(), 6U);
  EXPECT_EQ(world.send(first, 1, kAllFives).status, 303);
  EXPECT_EQ(world.send(first, 2, kAllFives).status, 303);
  EXPECT_THAT(first.get("/rate/bench").body, HasSubstr("2 of 6 sent"));
  EXPECT_THAT(first.get("/rate/bench").body, HasSubstr("Go on with replay 3"));
  EXPECT_THAT(second.get("/rate/bench").body, HasSubstr("0 of 6 sent"));
  EXPECT_THAT(first.get("/rate/replay?n=2").body, Not(HasSubstr("<form")));
  auto library = casedb::Library::open(world.folder);
  const auto sent = casedb::list_ratings(*library, world.code);
  EXPECT_EQ(sent->ratings.size(), 2U);
  EXPECT_EQ(sent->ratings[0].answers.at("comment").text, "fluid");
}

TEST(Rating, WhatIsTypedIsKeptAndWhatDoesNotFitIsSaid) {
  World world(false);
  FakeBrowser browser = world.rater(0);
  EXPECT_EQ(world.send(browser, 2, "item-flow=4&item-tissue=77&item-comment=half+a+sen", "keep").status, 204);
  FakeBrowser again(*world.site);  // the first one died
  again.cookies = browser.cookies;
  const std::string page = again.get("/rate/replay?n=2").body;
  EXPECT_THAT(page, HasSubstr("name=\"item-flow\" value=\"4\" checked"));
  EXPECT_THAT(page, HasSubstr("half a sen"));
  EXPECT_THAT(page, Not(HasSubstr("\"77\"")));
  const Response refused = world.send(browser, 2, "item-flow=6", "later");
  EXPECT_EQ(refused.status, 400);
  EXPECT_THAT(refused.body, HasSubstr("Please correct this"));
  const Response slip = world.send(browser, 2, "item-flow=5");
  EXPECT_EQ(slip.status, 400);
  EXPECT_THAT(slip.body, HasSubstr("Please rate this, or say that it is not applicable"));
  EXPECT_EQ(browser.post("/rate/replay", "n=2&go=keep&token=x").status, 403);
  EXPECT_EQ(world.send(browser, 99, kAllFives, "keep").status, 403) << "there is no such page, so no token";
}

TEST(Rating, OfTheCalibrationSetTheAgreedScoresFollowOnesOwn) {
  World world(false);
  FakeBrowser browser = world.rater(1);
  EXPECT_THAT(browser.get("/rate/replay?n=1").body, Not(HasSubstr("Agreed")));
  EXPECT_EQ(header_of(world.send(browser, 1, kAllFives), "Location"), "/rate/replay?n=1");
  EXPECT_THAT(browser.get("/rate/replay?n=1").body,
              HasSubstr("<th scope=\"row\">Respect for tissue</th><td>5</td><td>2</td>"));
  EXPECT_EQ(header_of(world.send(browser, 2, kAllFives), "Location"), "/rate/bench");
}

TEST(Rating, WithoutAKeyThereIsNoBench) {
  World world(false);
  FakeBrowser browser(*world.site);
  for (const char* path : {"/rate/bench", "/rate/replay?n=1"})
    EXPECT_EQ(header_of(browser.get(path), "Location"), "/rate");
  const std::string token = form_token(browser.get("/rate").body, "/rate");
  for (const std::string& key : {std::string(), std::string("abcd-efgh-jkmn"), world.code}) {
    const Response refused = browser.post("/rate", "key=" + key + "&token=" + token);
    EXPECT_EQ(refused.status, 404);
    EXPECT_THAT(refused.body, HasSubstr("No rater has that key"));
  }
  EXPECT_EQ(browser.post("/rate", "key=" + world.keys[0] + "&token=x").status, 403);
  // Nor is the round's code a way in for who answers questionnaires.
  const std::string answer = form_token(browser.get("/answer").body, "/answer");
  EXPECT_EQ(browser.post("/answer", "code=" + world.code + "&begin=yes&respondent=A1&token=" + answer).status, 400);
}

TEST(Rating, OnlyPagesOfAnswersMayRunTheScript) {
  World world(false);
  FakeBrowser browser = world.rater(0);
  const std::string rating = bytes_of(browser.get("/rate/replay?n=1"), true);
  EXPECT_THAT(rating, HasSubstr("script-src 'self'; connect-src 'self'"));
  EXPECT_THAT(rating, HasSubstr("img-src 'self' data:"));
  for (const char* path : {"/rate/bench", "/login", "/attempts"})
    EXPECT_THAT(bytes_of(browser.get(path), true), Not(HasSubstr("script-src"))) << path;
}

}  // namespace
}  // namespace seldinger::web
