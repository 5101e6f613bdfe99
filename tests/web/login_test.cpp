// Logging in and out through the pages: tokens, origins, cookies, expiry, throttling, faults.
#include <gmock/gmock.h>

#include "casedb/people/people.h"
#include "sim/base/failure.h"
#include "tests/web/fake_site.h"

namespace seldinger::web {
namespace {

using casedb::Role;
using ::testing::ContainsRegex;
using ::testing::HasSubstr;
using ::testing::MatchesRegex;
using ::testing::Not;

class LoginTest : public ::testing::Test {
 protected:
  FakeSite fake;
  FakeBrowser browser{*fake.site};
};

TEST_F(LoginTest, TheStartLeadsToTheFormAndBack) {
  EXPECT_EQ(header_of(browser.get("/"), "Location"), "/login");
  const Response logged_in = browser.log_in_as(Role::trainee);
  EXPECT_EQ(logged_in.status, 303);
  EXPECT_EQ(header_of(logged_in, "Location"), "/");
  EXPECT_EQ(browser.get("/").status, 200);
  EXPECT_EQ(header_of(browser.get("/login"), "Location"), "/");
  EXPECT_EQ(browser.get("/attempts").status, 200);
}

TEST_F(LoginTest, CookiesAreHttpOnlyStrictAndHold256Bits) {
  const std::string set = header_of(browser.log_in_as(Role::mentor), "Set-Cookie");
  EXPECT_THAT(set, HasSubstr("seldinger_8080=" + browser.cookies["seldinger_8080"] +
                             "; Path=/; HttpOnly; SameSite=Strict\n"));
  EXPECT_EQ(browser.cookies["seldinger_8080"].size(), 64U);
  EXPECT_EQ(browser.cookies.count("seldinger_before_login_8080"), 0U);
}

TEST_F(LoginTest, AnUnknownNameAndAWrongPasswordGetTheSamePage) {
  const Response unknown = browser.log_in("nobody", "wrong-password");
  const Response wrong = browser.log_in("mentor", "wrong-password");
  EXPECT_EQ(unknown.status, 403);
  EXPECT_EQ(wrong.status, 403);
  EXPECT_EQ(unknown.body, wrong.body);
  EXPECT_EQ(header_of(wrong, "Set-Cookie"), "");
  EXPECT_THAT(wrong.body, HasSubstr("Wrong name or password."));
}

TEST_F(LoginTest, NeedsTheTokenOfItsOwnForm) {
  browser.get("/login");
  FakeBrowser other(*fake.site);
  const std::string foreign = form_token(other.get("/login").body, "/login");
  for (const std::string& token : {std::string(), std::string(64, 'a'), foreign}) {
    const Response response = browser.post("/login", "name=trainee&password=correct+horse+battery&token=" + token);
    EXPECT_EQ(response.status, 403);
    EXPECT_EQ(browser.cookies.count("seldinger_8080"), 0U);
  }
  EXPECT_EQ(fake.questions.log_ins.load(), 0);
}

TEST_F(LoginTest, WithoutTheCookieOfTheFormTheTokenIsWorthNothing) {
  const std::string token = form_token(browser.get("/login").body, "/login");
  browser.cookies.clear();
  EXPECT_EQ(browser.post("/login", "name=trainee&password=correct+horse+battery&token=" + token).status, 403);
  EXPECT_EQ(fake.questions.log_ins.load(), 0);
}

TEST_F(LoginTest, EveryPostFromElsewhereIsRefusedBeforeAnythingHappens) {
  browser.log_in_as(Role::mentor);
  const std::string token = form_token(browser.get("/attempts").body, "/logout");
  ASSERT_EQ(token.size(), 64U);
  for (const char* path : {"/login", "/logout"}) {
    for (const char* site : {"", "cross-site", "same-site", "none"}) {
      Request request = browser.request("POST", path);
      request.body = "token=" + token;
      request.headers.erase("sec-fetch-site");
      if (*site != 0) request.headers["sec-fetch-site"] = site;
      EXPECT_EQ(browser.send(request).status, 403) << path << " " << site;
      request.headers["origin"] = "http://evil.example";
      request.headers["sec-fetch-site"] = "same-origin";
      EXPECT_EQ(browser.send(request).status, 403) << path;
      request.headers.erase("origin");
      request.headers.erase("sec-fetch-site");
      EXPECT_EQ(browser.send(request).status, 403) << path;
    }
  }
  EXPECT_EQ(browser.get("/attempts").status, 200);
}

TEST_F(LoginTest, LogOutNeedsItsTokenAndEndsTheSession) {
  browser.log_in_as(Role::mentor);
  const auto cookies = browser.cookies;
  EXPECT_EQ(browser.post("/logout", "").status, 403);
  EXPECT_EQ(browser.post("/logout", "token=" + std::string(64, 'b')).status, 403);
  EXPECT_EQ(browser.get("/attempts").status, 200);
  const std::string token = form_token(browser.get("/attempts").body, "/logout");
  EXPECT_EQ(header_of(browser.post("/logout", "token=" + token), "Location"), "/login");
  EXPECT_EQ(browser.cookies.count("seldinger_8080"), 0U);
  browser.cookies = cookies;  // a kept cookie opens nothing
  EXPECT_EQ(browser.get("/attempts").status, 303);
}

TEST_F(LoginTest, LoggingInAgainGivesANewSessionAndEndsTheOldOne) {
  browser.log_in_as(Role::trainee);
  const std::string first = browser.cookies["seldinger_8080"];
  FakeBrowser second(*fake.site);
  const std::string token = form_token(second.get("/login").body, "/login");
  second.cookies["seldinger_8080"] = first;
  second.post("/login", "name=mentor&password=correct+horse+battery&token=" + token);
  EXPECT_NE(second.cookies["seldinger_8080"], first);
  EXPECT_EQ(browser.get("/attempts").status, 303);
  EXPECT_EQ(second.get("/attempts").status, 200);
}

TEST_F(LoginTest, ASessionEndsByTheClock) {
  browser.log_in_as(Role::mentor);
  fake.now_us += kSessionIdle_us;
  EXPECT_EQ(header_of(browser.get("/attempts"), "Location"), "/login");
}

TEST_F(LoginTest, ANewPasswordEndsTheSessionsOfTheOldOne) {
  browser.log_in_as(Role::mentor);
  EXPECT_EQ(browser.get("/attempts").status, 200);
  for (casedb::Account& account : fake.questions.accounts) account.password_mark = "changed";
  EXPECT_EQ(browser.get("/attempts").status, 303);
}

TEST_F(LoginTest, ADisabledOrErasedAccountIsOutAtOnceAndStaysOut) {
  browser.log_in_as(Role::mentor);
  for (casedb::Account& account : fake.questions.accounts) account.enabled = account.login_name != "mentor";
  EXPECT_EQ(browser.get("/attempts").status, 303);
  for (casedb::Account& account : fake.questions.accounts) account.enabled = true;
  EXPECT_EQ(browser.get("/attempts").status, 303);

  FakeBrowser trainee(*fake.site);
  trainee.log_in_as(Role::trainee);
  std::erase_if(fake.questions.accounts, [](const casedb::Account& a) { return a.login_name == "trainee"; });
  EXPECT_EQ(trainee.get("/attempts").status, 303);
}

TEST_F(LoginTest, AChangedRoleHoldsAtOnce) {
  browser.log_in_as(Role::mentor);
  EXPECT_EQ(browser.get("/attempts/" + kOthersAttempt).status, 200);
  for (casedb::Account& account : fake.questions.accounts) {
    if (account.login_name == "mentor") account.role = Role::director;
  }
  EXPECT_EQ(browser.get("/attempts/" + kOthersAttempt).status, 404);
}

TEST_F(LoginTest, AfterFiveFailuresEvenTheRightPasswordWaitsAtThatPlace) {
  for (int i = 0; i < 5; ++i) EXPECT_EQ(browser.log_in("mentor", "wrong-password").status, 403);
  const Response refused = browser.log_in_as(Role::mentor);
  EXPECT_EQ(refused.status, 429);
  EXPECT_EQ(header_of(refused, "Retry-After"), "1");
  EXPECT_EQ(fake.questions.log_ins.load(), 5);  // no hash was computed
  fake.now_us += 1000000;
  EXPECT_EQ(browser.log_in_as(Role::mentor).status, 303);
}

// Was: victim 0 of 30 s, the wait rising to 15 min, for whoever knew a name.
TEST_F(LoginTest, WhoKnowsANameShutsItsOwnerOutNeitherFromElsewhereNorFromABrowserThatWasIn) {
  FakeBrowser known(*fake.site);
  ASSERT_EQ(known.log_in_as(Role::mentor).status, 303);
  ASSERT_EQ(known.post("/logout", "token=" + form_token(known.get("/attempts").body, "/logout")).status, 303);
  FakeBrowser logged_in(*fake.site);
  ASSERT_EQ(logged_in.log_in_as(Role::mentor).status, 303);
  const std::string session = logged_in.cookies["seldinger_8080"];
  for (int i = 0; i < 30; ++i) browser.log_in("mentor", "wrong-password");
  ASSERT_EQ(browser.log_in_as(Role::mentor).status, 429);
  FakeBrowser elsewhere(*fake.site);
  elsewhere.from = "127.0.0.9";
  EXPECT_EQ(elsewhere.log_in_as(Role::mentor).status, 303);
  EXPECT_EQ(known.log_in_as(Role::mentor).status, 303) << "of the same address";
  FakeBrowser with_session(*fake.site);
  const std::string token = form_token(with_session.get("/login").body, "/login");
  with_session.cookies["seldinger_8080"] = session;
  EXPECT_EQ(with_session.post("/login", "name=mentor&password=correct+horse+battery&token=" + token).status, 303);
  // It proves one name only, and its own failures count.
  known.cookies.erase("seldinger_8080");
  for (int i = 0; i < 5; ++i) EXPECT_EQ(known.log_in("mentor", "wrong-password").status, 403);
  EXPECT_EQ(known.log_in_as(Role::mentor).status, 429);
  for (int i = 0; i < 6; ++i) browser.log_in("trainee", "wrong-password");
  EXPECT_EQ(known.log_in_as(Role::trainee).status, 429);
  FakeBrowser forging(*fake.site);
  forging.cookies["seldinger_known_8080"] = std::string(128, 'a');
  EXPECT_EQ(forging.log_in_as(Role::mentor).status, 429);
}

// Was: 503 without a word to drop the cookie, and the session lived on for its twelve hours.
TEST_F(LoginTest, WhoLogsOutIsOutThoughTheLibraryCannotKeepIt) {
  browser.log_in_as(Role::mentor);
  const auto cookies = browser.cookies;
  const std::string token = form_token(browser.get("/attempts").body, "/logout");
  fake.questions.during_log_out = [] { throw base::Failure("disk", "the disk is full"); };
  EXPECT_EQ(header_of(browser.post("/logout", "token=" + token), "Location"), "/login");
  EXPECT_EQ(browser.cookies.count("seldinger_8080"), 0U);
  browser.cookies = cookies;
  EXPECT_EQ(browser.get("/attempts").status, 303);
  EXPECT_THAT(fake.log.back(), MatchesRegex("error [0-9a-f]{8}: disk: a log-out is not kept in the library"));
}

// Was: the right password counted five times as a failure while the disk was full, and its owner waited after that.
TEST_F(LoginTest, WhatTheLibraryCouldNotAnswerIsNoFailure) {
  fake.questions.during_log_in = [] { throw base::Failure("disk", "the disk is full"); };
  for (int i = 0; i < 8; ++i) EXPECT_EQ(browser.log_in_as(Role::mentor).status, 503) << i;
  fake.questions.during_log_in = {};
  for (int i = 0; i < 4; ++i) EXPECT_EQ(browser.log_in("mentor", "wrong-password").status, 403) << i;
  fake.questions.during_log_in = [] { throw base::Failure("disk", "the disk is full"); };
  EXPECT_EQ(browser.log_in_as(Role::mentor).status, 503);
  fake.questions.during_log_in = {};
  EXPECT_EQ(browser.log_in("mentor", "wrong-password").status, 403) << "the fifth";
  EXPECT_EQ(browser.log_in_as(Role::mentor).status, 429) << "failures of before are not forgotten";
}

// Was: 303, the new one ended with the old.
TEST_F(LoginTest, AnOldSessionDoesNotEndTheNewOne) {
  FakeBrowser old(*fake.site);
  old.log_in_as(Role::mentor);
  for (casedb::Account& account : fake.questions.accounts) account.password_mark = "changed";
  browser.log_in_as(Role::mentor);
  EXPECT_EQ(old.get("/attempts").status, 303);
  EXPECT_EQ(browser.get("/attempts").status, 200);
}

// Was: a line for each address, 5000 here.
TEST_F(LoginTest, TheLogIsBoundedHoweverManyAddressesFail) {
  for (int round = 0; round < 2; ++round) {
    for (int i = 0; i < 5000; ++i) fake.site->security.note("log-in failed", "192.0.2." + std::to_string(i));
    fake.now_us += 10000000;
  }
  EXPECT_EQ(fake.log.size(), 515U) << "twice 256 and one, and how many were left out of the first";
  EXPECT_THAT(fake.log, ::testing::Contains("security: more than are listed one by one; 4743 times more"));
}

// Was: 60 tries of all names together, then one a second: the victim was in 7 times of 14.
TEST_F(LoginTest, NamesThatNobodyHasShutNobodyOut) {
  for (int i = 0; i < 500; ++i) browser.log_in("nobody" + std::to_string(i), "wrong-password");
  EXPECT_EQ(browser.log_in_as(Role::mentor).status, 303);
}

TEST_F(LoginTest, AnAdminLetsSomebodyTryAgainAtOnce) {
  for (int i = 0; i < 7; ++i) browser.log_in("mentor", "wrong-password");
  for (int i = 0; i < 7; ++i) browser.log_in("A password typed as a name", "wrong-password");
  FakeBrowser admin(*fake.site);
  ASSERT_EQ(admin.log_in_as(Role::admin).status, 303);
  const std::string page = admin.get("/log-ins").body;
  EXPECT_THAT(page, HasSubstr("person-of-mentor"));
  EXPECT_THAT(page, Not(HasSubstr("typed as a name")));
  ASSERT_EQ(browser.log_in_as(Role::mentor).status, 429);
  const std::string token = form_token(page, "/log-ins");
  EXPECT_EQ(admin.post("/log-ins", "person=nobody&token=" + token).status, 404);
  EXPECT_EQ(admin.post("/log-ins", "person=person-of-mentor&token=" + token).status, 303);
  EXPECT_THAT(fake.questions.let_in, testing::ElementsAre("mentor"));
  EXPECT_EQ(browser.log_in_as(Role::mentor).status, 303);
  EXPECT_THAT(admin.get("/log-ins").body, HasSubstr("Nobody has to wait now."));
}

// Was: only this server's own page let anybody in again, and no log that stays told of it.
TEST_F(LoginTest, WhomACommandLetsInAgainIsInOnceMore) {
  for (int i = 0; i < 7; ++i) browser.log_in("mentor", "wrong-password");
  fake.questions.unlocked["person-of-trainee"] = 40;
  ASSERT_EQ(browser.log_in_as(Role::mentor).status, 429);
  fake.questions.unlocked["person-of-mentor"] = 41;  // `seldinger user unlock`
  for (int i = 0; i < 5; ++i) EXPECT_EQ(browser.log_in("mentor", "wrong-password").status, 403) << i;
  EXPECT_EQ(browser.log_in_as(Role::mentor).status, 429) << "it is heeded once";
  fake.questions.unlocked["person-of-mentor"] = 47;
  EXPECT_EQ(browser.log_in_as(Role::mentor).status, 303);
}

// Was: no line at all of any of it.
TEST_F(LoginTest, TheLogTellsWhatHappenedAndNamesNobody) {
  for (int i = 0; i < 7; ++i) browser.log_in("mentor", "wrong-password");
  browser.log_in("nobody", "wrong-password");
  FakeBrowser trainee(*fake.site);
  trainee.log_in_as(Role::trainee);
  for (casedb::Account& account : fake.questions.accounts) account.password_mark = "changed";
  trainee.get("/attempts");
  fake.now_us += 10000000;
  browser.log_in("nobody", "wrong-password");
  std::string all;
  for (const std::string& line : fake.log) all += line + "\n";
  EXPECT_THAT(all, ContainsRegex("security: log-in failed; address [0-9a-f]{8}; account person-of-mentor\n"));
  EXPECT_THAT(all, ContainsRegex("security: log-in failed; address [0-9a-f]{8}\n"));
  EXPECT_THAT(
      all, ContainsRegex("security: log-in failed; address [0-9a-f]{8}; account person-of-mentor; 4 times more\n"));
  EXPECT_THAT(all, ContainsRegex("security: log-in delayed; address [0-9a-f]{8}; account person-of-mentor\n"));
  EXPECT_THAT(all, ContainsRegex("security: logged in; address [0-9a-f]{8}; account person-of-trainee\n"));
  EXPECT_THAT(all,
              ContainsRegex("security: session ended: the account was changed; .*account person-of-trainee\n"));
  EXPECT_THAT(all, Not(HasSubstr("127.0.0.1")));
  EXPECT_THAT(all, Not(HasSubstr("nobody")));
}

TEST_F(LoginTest, ACheckIsMadeOnceForEachVersionOfACase) {
  browser.log_in_as(Role::mentor);
  const std::string path = "/cases/" + kDraftCase + "/checks.json";
  const std::string first = browser.get(path).body;
  EXPECT_THAT(first, HasSubstr("lesion_present"));
  EXPECT_EQ(browser.get(path).body, first);
  EXPECT_EQ(fake.questions.case_checks.load(), 1);  // was: one each time
  fake.questions.mark = "drawn anew";
  EXPECT_EQ(browser.get(path).status, 200);
  EXPECT_EQ(fake.questions.case_checks.load(), 2);
  fake.questions.during_check = [&] { fake.questions.mark = "changed meanwhile"; };
  fake.questions.mark = "once more";
  browser.get(path);
  fake.questions.during_check = {};
  fake.questions.mark = "once more";
  browser.get(path);
  EXPECT_EQ(fake.questions.case_checks.load(), 4) << "what was found of another state is not kept";
  fake.questions.mark = "damaged";
  fake.questions.check_refusal = base::Error{"asset_damaged", "is damaged"};
  EXPECT_EQ(browser.get(path).status, 500);
}

TEST_F(LoginTest, HealthTellsWhatTheLibraryCannotDo) {
  using casedb::Health;
  for (const auto& [health, status] :
       {std::pair{Health::ok, 200}, {Health::moved, 503}, {Health::full, 503}, {Health::read_only, 503}}) {
    fake.questions.health_now = health;
    const Response response = browser.get("/healthz");
    EXPECT_EQ(response.status, status);
    EXPECT_EQ(response.body,
              "{\"status\":\"" + std::string(casedb::name_of(health)) + "\",\"version\":\"9.8.7\"}\n");
  }
}

TEST_F(LoginTest, OnlyFormsAreRead) {
  browser.log_in_as(Role::mentor);
  for (const char* type : {"", "application/json", "multipart/form-data; boundary=x", "text/plain"}) {
    Request request = browser.request("POST", "/logout");
    request.headers["content-type"] = type;
    EXPECT_EQ(browser.send(request).status, 415) << type;
  }
  EXPECT_EQ(browser.post("/logout", "token=%zz").status, 400);
  EXPECT_EQ(browser.post("/logout", "token=a&token=b").status, 400);
}

TEST_F(LoginTest, AForeignHostNameIsRefusedEverywhere) {
  browser.log_in_as(Role::mentor);
  for (const char* path : {"/", "/healthz", "/attempts", "/style.css", "/nothing"}) {
    Request request = browser.request("GET", path);
    for (const char* host : {"evil.example:8080", "", "127.0.0.1.evil.example"}) {
      request.headers["host"] = host;
      EXPECT_EQ(browser.send(request).status, 421) << path << " " << host;
    }
  }
}

TEST_F(LoginTest, FaultsOfTheLibrarySayNothingOfTheInside) {
  browser.log_in_as(Role::mentor);
  fake.questions.fault = [] { throw base::Failure("database", "the database is busy"); };
  const Response gone = browser.get("/attempts");
  EXPECT_EQ(gone.status, 503);
  EXPECT_THAT(gone.body, Not(HasSubstr("busy")));
  fake.questions.fault = [] { throw std::runtime_error("SECRET db path /srv/x"); };
  const Response broken = browser.get("/attempts");
  EXPECT_EQ(broken.status, 500);
  EXPECT_THAT(bytes_of(broken, true), Not(HasSubstr("SECRET")));
  fake.questions.fault = [] { throw 42; };
  EXPECT_EQ(browser.get("/attempts").status, 500);
  ASSERT_EQ(fake.log.size(), 3U);
  EXPECT_THAT(fake.log[0], HasSubstr("security: logged in"));
  EXPECT_THAT(fake.log[1], MatchesRegex("error [0-9a-f]{8}: database: the database is busy"));
  EXPECT_THAT(fake.log[2], Not(HasSubstr("SECRET")));
  // Was: the page sent its reader to a line of the log that nothing tells from the others.
  EXPECT_THAT(gone.body, HasSubstr("has a line about it: " + fake.log[1].substr(6, 8)));
  EXPECT_THAT(broken.body, HasSubstr("has a line about it: " + fake.log[2].substr(6, 8)));
}

}  // namespace
}  // namespace seldinger::web
