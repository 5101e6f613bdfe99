// Logging in and out through the pages: tokens, origins, cookies, expiry, throttling, faults.
#include <gmock/gmock.h>

#include "casedb/people/people.h"
#include "tests/web/fake_site.h"

namespace seldinger::web {
namespace {

using casedb::Role;
using ::testing::HasSubstr;
using ::testing::Not;

class LoginTest : public ::testing::Test {
 protected:
  FakeSite fake;
  FakeBrowser browser{*fake.site};
};

TEST_F(LoginTest, TheStartLeadsToTheFormThenToTheAttempts) {
  EXPECT_EQ(header_of(browser.get("/"), "Location"), "/login");
  const Response logged_in = browser.log_in_as(Role::trainee);
  EXPECT_EQ(logged_in.status, 303);
  EXPECT_EQ(header_of(logged_in, "Location"), "/attempts");
  EXPECT_EQ(header_of(browser.get("/"), "Location"), "/attempts");
  EXPECT_EQ(header_of(browser.get("/login"), "Location"), "/attempts");
  EXPECT_EQ(browser.get("/attempts").status, 200);
}

TEST_F(LoginTest, CookiesAreHttpOnlyStrictAndHold256Bits) {
  const std::string set = header_of(browser.log_in_as(Role::mentor), "Set-Cookie");
  EXPECT_THAT(set, HasSubstr("seldinger_session=" + browser.cookies["seldinger_session"] +
                             "; Path=/; HttpOnly; SameSite=Strict\n"));
  EXPECT_EQ(browser.cookies["seldinger_session"].size(), 64U);
  EXPECT_EQ(browser.cookies.count("seldinger_before_login"), 0U);
}

TEST_F(LoginTest, AnUnknownNameAndAWrongPasswordGetTheSamePage) {
  const Response unknown = browser.log_in("nobody", "wrong-password");
  const Response wrong = browser.log_in("mentor", "wrong-password");
  EXPECT_EQ(unknown.status, 403);
  EXPECT_EQ(wrong.status, 403);
  EXPECT_EQ(unknown.body, wrong.body);
  EXPECT_EQ(header_of(wrong, "Set-Cookie"), "");
  EXPECT_THAT(wrong.body, HasSubstr("Name and password do not fit."));
}

TEST_F(LoginTest, NeedsTheTokenOfItsOwnForm) {
  browser.get("/login");
  FakeBrowser other(*fake.site);
  const std::string foreign = form_token(other.get("/login").body, "/login");
  for (const std::string& token : {std::string(), std::string(64, 'a'), foreign}) {
    const Response response = browser.post("/login", "name=trainee&password=correct+horse+battery&token=" + token);
    EXPECT_EQ(response.status, 403);
    EXPECT_EQ(browser.cookies.count("seldinger_session"), 0U);
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
  EXPECT_EQ(browser.cookies.count("seldinger_session"), 0U);
  browser.cookies = cookies;  // a kept cookie opens nothing
  EXPECT_EQ(browser.get("/attempts").status, 303);
}

TEST_F(LoginTest, LoggingInAgainGivesANewSessionAndEndsTheOldOne) {
  browser.log_in_as(Role::trainee);
  const std::string first = browser.cookies["seldinger_session"];
  FakeBrowser second(*fake.site);
  const std::string token = form_token(second.get("/login").body, "/login");
  second.cookies["seldinger_session"] = first;
  second.post("/login", "name=mentor&password=correct+horse+battery&token=" + token);
  EXPECT_NE(second.cookies["seldinger_session"], first);
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

TEST_F(LoginTest, AfterFiveFailuresEvenTheRightPasswordWaits) {
  for (int i = 0; i < 5; ++i) EXPECT_EQ(browser.log_in("mentor", "wrong-password").status, 403);
  const Response refused = browser.log_in_as(Role::mentor);
  EXPECT_EQ(refused.status, 429);
  EXPECT_EQ(header_of(refused, "Retry-After"), "1");
  EXPECT_EQ(fake.questions.log_ins.load(), 5);  // no hash was computed
  fake.now_us += 1000000;
  EXPECT_EQ(browser.log_in_as(Role::mentor).status, 303);
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
  ASSERT_EQ(fake.log.size(), 2U);
  EXPECT_EQ(fake.log[0], "error: database: the database is busy");
  EXPECT_THAT(fake.log[1], Not(HasSubstr("SECRET")));
}

}  // namespace
}  // namespace seldinger::web
