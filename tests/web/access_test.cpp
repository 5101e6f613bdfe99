// Who sees what: every role on every route, for what is their own, another's, nobody's and missing.
#include "web/access.h"

#include <gmock/gmock.h>

#include <set>

#include "tests/web/fake_site.h"
#include "web/routes.h"

namespace seldinger::web {
namespace {

using casedb::Role;
using ::testing::HasSubstr;
using ::testing::Not;

enum class Whose { own, others, nobodys, missing };
constexpr Role kRoles[] = {Role::trainee, Role::mentor, Role::researcher, Role::director, Role::admin};

const std::string& attempt_of(Whose whose) {
  switch (whose) {
    case Whose::own:
      return kOwnAttempt;
    case Whose::others:
      return kOthersAttempt;
    case Whose::nobodys:
      return kNobodysAttempt;
    case Whose::missing:
      break;
  }
  return kMissingAttempt;
}

// The table of the brief, written apart from the program's.
bool may_read(Role role, Whose whose) {
  if (whose == Whose::missing) return false;
  if (role == Role::mentor || role == Role::researcher) return true;
  return role == Role::trainee && whose == Whose::own;
}

std::string filled(std::string_view pattern, const std::string& attempt_id) {
  std::string path(pattern);
  if (const std::size_t at = path.find('{'); at != path.npos) path.replace(at, path.find('}') - at + 1, attempt_id);
  return path;
}

// What GET answers to somebody of this role; -1 for a path the table does not know.
int expected_status(std::string_view pattern, Role role, Whose whose) {
  if (pattern == "/curricula") return role == Role::admin ? 404 : 200;
  if (pattern == "/cases") return role == Role::trainee ? 404 : 200;
  if (pattern.substr(0, 7) == "/cases/") return 404;  // these ids are attempts'
  if (pattern == "/healthz" || pattern == "/style.css") return 200;
  if (pattern == "/" || pattern == "/login") return 303;
  if (pattern == "/attempts" || pattern == "/metrics") return 200;
  if (pattern.substr(0, 23) == "/attempts/{attempt_id}") return may_read(role, whose) ? 200 : 404;
  if (pattern.substr(0, 23) == "/attempts/{attempt_id}/") return may_read(role, whose) ? 200 : 404;
  return -1;
}

TEST(AccessMatrix, EveryRoleOnEveryRouteAnswersAsTheTableSays) {
  int checks = 0;
  for (const Role role : kRoles) {
    FakeSite fake;
    fake.questions.attempts[0].person_id = "person-of-" + casedb::name_of(role);
    FakeBrowser browser(*fake.site);
    ASSERT_EQ(browser.log_in_as(role).status, 303);
    for (const Route& route : routes()) {
      if (route.method != "GET") continue;
      for (const Whose whose : {Whose::own, Whose::others, Whose::nobodys, Whose::missing}) {
        const std::string path = filled(route.pattern, attempt_of(whose));
        for (const char* method : {"GET", "HEAD"}) {
          const int status = browser.send(browser.request(method, path)).status;
          EXPECT_EQ(status, expected_status(route.pattern, role, whose)) << casedb::name_of(role) << " " << path;
          ++checks;
        }
      }
    }
  }
  EXPECT_EQ(checks, 5 * 15 * 4 * 2);
}

TEST(AccessMatrix, LoggedOutEverythingButTheOpenRoutesIsClosed) {
  FakeSite fake;
  FakeBrowser browser(*fake.site);
  const std::set<std::string_view> open = {"/healthz", "/style.css", "/login"};
  for (const Route& route : routes()) {
    if (route.method != "GET") continue;
    for (const Whose whose : {Whose::own, Whose::missing}) {
      browser.cookies.clear();
      const Response response = browser.get(filled(route.pattern, attempt_of(whose)));
      if (open.count(route.pattern) != 0) {
        EXPECT_EQ(response.status, 200) << route.pattern;
      } else if (route.is_page) {
        EXPECT_EQ(response.status, 303) << route.pattern;
        EXPECT_EQ(header_of(response, "Location"), "/login");
      } else {
        EXPECT_EQ(response.status, 401) << route.pattern;
      }
      EXPECT_THAT(response.body, Not(HasSubstr("Case of")));
    }
  }
  EXPECT_EQ(browser.post("/logout", "token=x").status, 303);
}

TEST(AccessMatrix, AForbiddenAttemptIsByteForByteAMissingOne) {
  for (const Role role : {Role::trainee, Role::director, Role::admin}) {
    FakeSite fake;
    FakeBrowser browser(*fake.site);
    browser.log_in_as(role);
    for (const char* end : {"", "/picture.png", "/metrics.json", "/grade.json"}) {
      const Response forbidden = browser.get("/attempts/" + kOthersAttempt + end);
      const Response missing = browser.get("/attempts/" + kMissingAttempt + end);
      EXPECT_EQ(bytes_of(forbidden, true), bytes_of(missing, true));
    }
  }
}

TEST(AccessMatrix, ListsHoldExactlyWhatMayBeOpened) {
  for (const Role role : kRoles) {
    FakeSite fake;
    FakeBrowser browser(*fake.site);
    fake.questions.attempts[0].person_id = "person-of-" + casedb::name_of(role);
    browser.log_in_as(role);
    const std::string list = browser.get("/attempts").body;
    for (const Whose whose : {Whose::own, Whose::others, Whose::nobodys}) {
      const std::string link = "href=\"/attempts/" + attempt_of(whose) + "\"";
      EXPECT_EQ(list.find(link) != list.npos, may_read(role, whose)) << casedb::name_of(role);
    }
    if (role == Role::director || role == Role::admin) {
      EXPECT_THAT(list, HasSubstr("does not see individual attempts"));
    }
  }
}

TEST(AccessMatrix, CurriculaAreSeenAsTheTableSays) {
  const std::map<Role, std::set<std::string>> sees = {{Role::trainee, {"published"}},
                                                      {Role::mentor, {"draft", "published", "retired"}},
                                                      {Role::researcher, {"published", "retired"}},
                                                      {Role::director, {"draft", "published", "retired"}},
                                                      {Role::admin, {}}};
  for (const Role role : kRoles) {
    FakeSite fake;
    FakeBrowser browser(*fake.site);
    browser.log_in_as(role);
    const std::string body = browser.get("/curricula").body;
    for (const std::string state : {"draft", "published", "retired"})
      EXPECT_EQ(body.find("A " + state + " curriculum") != body.npos, sees.at(role).contains(state))
          << casedb::name_of(role) << " " << state;
    const auto asked_for = role == Role::trainee ? std::optional<std::string>("person-of-trainee") : std::nullopt;
    EXPECT_EQ(fake.questions.curricula_asked_for, asked_for) << "nobody sees how far another is";
  }
}

TEST(AccessMatrix, WhichAttemptsSetAStandardIsSeenByWhoSeesThem) {
  for (const Role role : {Role::trainee, Role::mentor, Role::researcher}) {
    FakeSite fake;
    FakeBrowser browser(*fake.site);
    browser.log_in_as(role);
    const std::string body = browser.get("/attempts/" + kOwnAttempt + "/grade.json").body;
    EXPECT_THAT(body, HasSubstr("\"set_id\":\"C-1\""));
    EXPECT_EQ(body.find(kMissingAttempt) == body.npos, role == Role::trainee) << casedb::name_of(role);
  }
}

TEST(AccessMatrix, TenThousandOtherIdsLeakNothing) {
  FakeSite fake;
  FakeBrowser browser(*fake.site);
  browser.log_in_as(Role::trainee);
  for (int i = 0; i < 10000; ++i) {
    std::string id = kOwnAttempt;
    const std::string random = fake_hash(std::to_string(i));
    // One to eight digits of the own id replaced: neighbours first, which hold the other attempts.
    for (int k = 0; k <= i % 8; ++k) id[35 - k] = random[static_cast<std::size_t>(k)];
    if (id == kOwnAttempt) continue;
    const Response response = browser.get("/attempts/" + id);
    ASSERT_EQ(response.status, 404) << id;
    ASSERT_THAT(response.body, Not(HasSubstr("Case of")));
  }
}

// assessment.md §10: who reads which state of a case, written apart from the program.
TEST(AccessMatrix, CasesAreSeenByRoleAndState) {
  const std::pair<std::string, std::set<Role>> readers[] = {
      {kDraftCase, {Role::mentor}},
      {kReviewCase, {Role::mentor, Role::director}},
      {kPublishedCase, {Role::mentor, Role::director, Role::researcher, Role::admin}},
      {kRetiredCase, {Role::mentor, Role::director, Role::researcher, Role::admin}},
      {kMissingAttempt, {}}};
  for (const Role role : kRoles) {
    FakeSite fake;
    FakeBrowser browser(*fake.site);
    browser.log_in_as(role);
    const std::string list = browser.get("/cases").body;
    for (const auto& [id, who] : readers) {
      const bool may = who.count(role) != 0;
      for (const char* end : {"", "/case.json", "/checks.json"}) {
        const Response response = browser.get("/cases/" + id + end);
        EXPECT_EQ(response.status, may ? 200 : 404) << casedb::name_of(role) << " " << id << end;
        if (!may) {
          EXPECT_EQ(bytes_of(response, true), bytes_of(browser.get("/cases/" + kMissingAttempt + end), true));
        }
      }
      EXPECT_EQ(list.find(id) != list.npos, may) << casedb::name_of(role) << " " << id;
    }
  }
}

TEST(Cases, APageNamesWhatItHoldsAndEscapesIt) {
  FakeSite fake;
  FakeBrowser browser(*fake.site);
  fake.questions.cases[0].title = "<script>x</script>";
  fake.questions.cases[0].clinic.indication = "\"quoted\" & <b>";
  fake.questions.cases[0].rule.criteria = {*assessment::criterion_from("hit >= 1"),
                                           *assessment::criterion_from("core_in_target >= 8")};
  fake.questions.cases[0].rule.criteria[1].critical = true;
  browser.log_in_as(Role::mentor);
  const std::string page = browser.get("/cases/" + kDraftCase).body;
  EXPECT_THAT(page, Not(HasSubstr("<script>x")));
  EXPECT_THAT(page, Not(HasSubstr("<b>")));
  EXPECT_THAT(page, HasSubstr("Target hit</th><td>Yes</td>"));
  EXPECT_THAT(page, HasSubstr("at least 8.0 mm; missing it is a critical error"));
  EXPECT_THAT(page, HasSubstr("provisional"));
  EXPECT_THAT(page, HasSubstr("draft, version 1"));
  EXPECT_THAT(browser.get("/cases/" + kDraftCase + "/checks.json").body, HasSubstr("\"holds\":false"));
  EXPECT_THAT(browser.get("/cases/" + kDraftCase + "/case.json").body, HasSubstr("\"metric\":\"hit\""));
}

TEST(AccessNames, AResearcherReadsPseudonymsAMentorNames) {
  FakeSite fake;
  FakeBrowser researcher(*fake.site), mentor(*fake.site);
  researcher.log_in_as(Role::researcher);
  mentor.log_in_as(Role::mentor);
  for (const std::string& path : {std::string("/attempts"), "/attempts/" + kOthersAttempt}) {
    EXPECT_THAT(mentor.get(path).body, HasSubstr("Other Trainee"));
    const std::string pseudonymous = researcher.get(path).body;
    EXPECT_THAT(pseudonymous, Not(HasSubstr("Other Trainee")));
    EXPECT_THAT(pseudonymous, HasSubstr("Person zzz999"));
    EXPECT_THAT(pseudonymous, Not(HasSubstr("person-of-other")));
  }
  EXPECT_THAT(mentor.get("/attempts/" + kNobodysAttempt).body, HasSubstr("Simulated novice"));
}

TEST(AccessNames, APersonWhoseAccountIsGoneHasAPseudonym) {
  const casedb::Account mentor{"m", "Mia", Role::mentor, true};
  const auto nobody = [](const std::string&) { return std::nullopt; };
  EXPECT_EQ(operator_label(mentor, attempt_row(kOwnAttempt, "0190-abcdef123456"), nobody), "Person 123456");
  EXPECT_EQ(operator_label(mentor, attempt_row(kOwnAttempt, "x"), nobody), "Person x");
  // An account's attempt that a simulated operator made is none of a person's.
  casedb::AttemptRow simulated = attempt_row(kOwnAttempt, "x");
  simulated.operator_name = "expert";
  EXPECT_EQ(operator_label(mentor, simulated, nobody), "Simulated expert");
}

TEST(Routes, OtherMethodsAndOtherPathsAreRefused) {
  FakeSite fake;
  FakeBrowser browser(*fake.site);
  browser.log_in_as(Role::mentor);
  for (const char* method : {"PUT", "DELETE", "OPTIONS", "TRACE", "PATCH", "CONNECT"}) {
    const Response response = browser.send(browser.request(method, "/attempts"));
    EXPECT_EQ(response.status, 405) << method;
    EXPECT_EQ(header_of(response, "Allow"), "GET, HEAD");
  }
  EXPECT_EQ(header_of(browser.send(browser.request("PUT", "/login")), "Allow"), "GET, HEAD, POST");
  for (const char* path : {"/nothing", "/attempts/", "/attempts/x", "/../attempts", "//attempts", "/attempts/..",
                           "/attempts/0190A1B2-0000-7000-8000-0000000000A1", "/style.css/", "/favicon.ico",
                           "/attempts/0190a1b2-0000-7000-8000-0000000000a1/", "/LOGIN"}) {
    EXPECT_EQ(browser.get(path).status, 404) << path;
    EXPECT_EQ(browser.post(path, "token=x").status, 404) << path;
  }
}

TEST(Routes, PagesOfALongListAreCutAndClamped) {
  FakeSite fake;
  FakeBrowser browser(*fake.site);
  fake.questions.attempts.clear();
  for (int i = 0; i < 120; ++i) {
    std::string id = kOwnAttempt;
    id.replace(33, 3, std::to_string(100 + i));
    fake.questions.attempts.push_back(attempt_row(id, std::nullopt));
  }
  browser.log_in_as(Role::mentor);
  const auto shown = [&](const std::string& path) {
    const std::string html = browser.get(path).body;
    std::size_t count = 0;
    for (std::size_t at = html.find("<tr><th scope=\"row\">"); at != html.npos;
         at = html.find("<tr><th scope=\"row\">", at + 1)) {
      ++count;
    }
    return count;
  };
  EXPECT_EQ(shown("/attempts"), 50U);
  EXPECT_EQ(shown("/attempts?page=3"), 20U);
  EXPECT_EQ(shown("/attempts?page=99999999999999999999999"), 50U);
  for (const char* odd : {"0", "-1", "x", "", "1e3"})
    EXPECT_EQ(shown(std::string("/attempts?page=") + odd), 50U) << odd;
  EXPECT_EQ(shown("/attempts?page=77"), 20U);
}

TEST(Routes, PictureHealthAndMetricsAnswerInTheirTypes) {
  FakeSite fake;
  FakeBrowser browser(*fake.site);
  browser.log_in_as(Role::mentor);
  const Response picture = browser.get("/attempts/" + kOwnAttempt + "/picture.png");
  EXPECT_EQ(picture.content_type, "image/png");
  EXPECT_EQ(picture.body.size(), fake.questions.picture.size());
  const Response metrics = browser.get("/attempts/" + kOwnAttempt + "/metrics.json");
  EXPECT_EQ(metrics.content_type, "application/json");
  EXPECT_EQ(
      metrics.body,
      R"({"attempt_id":")" + kOwnAttempt +
          R"(","synthetic":false,"metrics":[{"id":"hit","version":1,"value":1.0,"unit":"bool","reason":null},)"
          R"({"id":"vis_joint","version":1,"value":null,"unit":"share","reason":"no_endpoint"}]})"
          "\n");
  EXPECT_EQ(browser.get("/healthz").body, "{\"status\":\"ok\",\"version\":\"9.8.7\"}\n");
  EXPECT_EQ(browser.get("/style.css").content_type, "text/css; charset=utf-8");
}

TEST(Routes, APictureThatIsNoneIsNotServed) {
  FakeSite fake;
  FakeBrowser browser(*fake.site);
  browser.log_in_as(Role::mentor);
  fake.questions.picture = std::vector<std::byte>(100, std::byte{'<'});
  EXPECT_EQ(browser.get("/attempts/" + kOwnAttempt + "/picture.png").status, 500);
  fake.questions.attempts[0].picture_sha256.clear();
  EXPECT_EQ(browser.get("/attempts/" + kOwnAttempt + "/picture.png").status, 404);
}

}  // namespace
}  // namespace seldinger::web
