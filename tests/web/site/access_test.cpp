// Who sees what: every role on every route, for what is their own, another's, nobody's and missing.
#include "web/site/access.h"

#include <gmock/gmock.h>

#include <set>
#include <vector>

#include "reports/words/attempt_words.h"
#include "tests/web/fake_site.h"
#include "web/routes/routes.h"

namespace seldinger::web {
namespace {

using casedb::Role;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr auto& kRoles = casedb::kAllRoles;
using casedb::Action;
using casedb::Relation;

std::string filled(std::string_view pattern, const std::string& id) {
  std::string path(pattern);
  if (const std::size_t at = path.find('{'); at != path.npos) path.replace(at, path.find('}') - at + 1, id);
  return path;
}

// Everything that somebody can be to somebody else, and nobody's.
std::vector<Relation> every_relation() {
  std::vector<Relation> all;
  for (unsigned bits = 0; bits < 16; ++bits) {
    Relation relation;
    relation.own = (bits & 1U) != 0;
    relation.own_cohort = (bits & 2U) != 0;
    relation.own_programme = (bits & 4U) != 0;
    relation.own_study = (bits & 8U) != 0;
    all.push_back(relation);
  }
  Relation nobodys;
  nobodys.nobodys = true;
  all.push_back(nobodys);
  return all;
}

std::string words_of(const Relation& relation) {
  std::string words;
  for (const auto& [is, word] : {std::pair{relation.own, "own "},
                                 {relation.own_cohort, "cohort "},
                                 {relation.own_programme, "programme "},
                                 {relation.own_study, "study "},
                                 {relation.nobodys, "nobody's "}})
    if (is) words += word;
  return words;
}

// Generated from the table of permissions: each route names its action, and answers to every role and every
// relation what casedb::may says, which permissions_test.cpp holds to a matrix of its own.
TEST(AccessMatrix, EveryRouteAnswersEveryRoleAndRelationAsTheTableSays) {
  int checks = 0, allowed = 0;
  for (const Role role : kRoles) {
    FakeSite fake;
    FakeBrowser browser(*fake.site);
    ASSERT_EQ(browser.log_in_as(role).status, 303);
    for (const Relation& relation : every_relation()) {
      give(fake, role, relation);
      for (const Route& route : routes()) {
        if (!route.who.action) continue;
        const bool of_an_attempt = route.pattern.find("{attempt_id}") != route.pattern.npos;
        if (route.pattern.find("{case_id}") != route.pattern.npos) continue;  // by state, below
        if (route.pattern.starts_with("/jobs/") || (route.pattern == "/jobs" && route.method == "POST"))
          continue;  // by whose it is, in jobs_test.cpp
        Relation own;
        own.own = true;
        const bool is_change = route.method == "POST";
        // A route without an id is about the reader, or a list that is filtered.
        const bool of_a_person = route.pattern.find("{person_id}") != route.pattern.npos;
        const bool of_a_study = route.pattern.find("{study_id}") != route.pattern.npos;
        const bool may = of_an_attempt || of_a_person || of_a_study
                             ? casedb::may(role, *route.who.action, relation)
                             : casedb::roles_that_may(*route.who.action).has(role) &&
                                   (!is_change || casedb::may(role, *route.who.action, own));
        const std::string path = filled(route.pattern, of_a_person ? kSomebody : of_a_study ? kStudy : kOwnAttempt);
        const std::string words = casedb::name_of(role) + " " + words_of(relation) + path;
        if (is_change) {
          const std::string token = form_token(browser.get("/me").body, "/me/facts");
          fake.questions.done.clear();
          const int status =
              browser.post(path, "sure=yes&answer=give&text=x&person=person-of-trainee&token=" + token).status;
          EXPECT_EQ(status, !may ? 404 : route.pattern == "/accounts" ? 200 : 303) << words;  // a link is shown
          if (route.scope == "of oneself") {
            EXPECT_EQ(!fake.questions.done.empty(), may) << words;
          }
          for (const std::string& one : fake.questions.done)
            EXPECT_THAT(one, HasSubstr("person-of-" + casedb::name_of(role))) << "nobody answers for another";
          ++checks;
        } else {
          for (const char* method : {"GET", "HEAD"}) {
            EXPECT_EQ(browser.send(browser.request(method, path)).status, may ? 200 : 404) << words;
            ++checks;
          }
        }
        allowed += may ? 1 : 0;
      }
      // The list holds exactly what may be opened, and a name only where the table lets it be read.
      const std::string list = browser.get("/attempts").body;
      const bool listed = list.find("/attempts/" + kOwnAttempt) != list.npos;
      EXPECT_EQ(listed, casedb::may(role, Action::see_attempt, relation))
          << casedb::name_of(role) << " " << words_of(relation);
      if (!relation.own) {
        EXPECT_EQ(list.find("Other Trainee") != list.npos,
                  listed && !relation.nobodys && casedb::may(role, Action::see_operator_name, relation))
            << casedb::name_of(role) << " " << words_of(relation);
      }
      checks += 2;
    }
  }
  EXPECT_EQ(checks, 5 * 17 * (38 * 2 + 6 + 2));
  EXPECT_GT(allowed, 300) << "a site that answers nobody would pass an empty table";
}

TEST(AccessMatrix, RoutesWithoutAnActionAreThoseOfNoSecret) {
  std::set<std::string_view> without;
  for (const Route& route : routes())
    if (!route.who.action) without.insert(route.pattern);
  EXPECT_EQ(without, (std::set<std::string_view>{"/healthz",     "/style.css",     "/",          "/login",
                                                 "/logout",      "/attempts",      "/metrics",   "/answer",
                                                 "/answer/form", "/answer/thanks", "/answer.js", "/rate",
                                                 "/rate/bench",  "/rate/replay",   "/replay.js", "/openapi.json",
                                                 "/board",       "/film.js",       "/tables.js", "/password",
                                                 "/icon.svg",    "/prometheus",    "/jobs.js"}))
      << "a new route names its action";
}

TEST(AccessMatrix, LoggedOutEverythingButTheOpenRoutesIsClosed) {
  FakeSite fake;
  FakeBrowser browser(*fake.site);
  const std::set<std::string_view> open = {"/healthz",       "/style.css", "/login",      "/answer",
                                           "/answer/thanks", "/answer.js", "/rate",       "/replay.js",
                                           "/openapi.json",  "/board",     "/film.js",    "/tables.js",
                                           "/password",      "/icon.svg",  "/prometheus", "/jobs.js"};
  for (const Route& route : routes()) {
    if (route.method != "GET") continue;
    for (const std::string& id : {kOwnAttempt, kMissingAttempt}) {
      browser.cookies.clear();
      const Response response = browser.get(filled(route.pattern, id));
      if (open.count(route.pattern) != 0) {
        EXPECT_EQ(response.status, 200) << route.pattern;
      } else if (route.is_page) {
        EXPECT_EQ(response.status, 303) << route.pattern;
        const std::string pattern(route.pattern);
        EXPECT_EQ(header_of(response, "Location"), pattern == "/answer/form"       ? "/answer"
                                                   : pattern.starts_with("/rate/") ? "/rate"
                                                                                   : "/login");
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
    fake.questions.relations.clear();
    browser.log_in_as(role);
    for (const char* end : {"", "/picture.png", "/replay.json", "/metrics.json", "/grade.json", "/pictures",
                            "/pictures.png", "/pictures.png?n=2"}) {
      const Response forbidden = browser.get("/attempts/" + kOthersAttempt + end);
      const Response missing = browser.get("/attempts/" + kMissingAttempt + end);
      EXPECT_EQ(bytes_of(forbidden, true), bytes_of(missing, true));
    }
  }
}

TEST(AccessMatrix, AnAdminIsToldThatThereIsNothingToSee) {
  FakeSite fake;
  FakeBrowser browser(*fake.site);
  browser.log_in_as(Role::admin);
  EXPECT_THAT(browser.get("/attempts").body, HasSubstr("does not see individual attempts"));
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
  for (const Role role : {Role::trainee, Role::mentor, Role::researcher, Role::director}) {
    FakeSite fake;
    FakeBrowser browser(*fake.site);
    browser.log_in_as(role);
    const std::string attempt = role == Role::trainee ? kOwnAttempt : kOthersAttempt;
    const std::string body = browser.get("/attempts/" + attempt + "/grade.json").body;
    // Before, everybody read how many people a standard to come has, and when the last of them had made an attempt.
    for (const std::string& told :
         {kMissingAttempt, std::string("\"set_id\":\"C-1\""), std::string("newest_us"), std::string("\"people\"")})
      EXPECT_EQ(body.find(told) != body.npos, casedb::may(role, Action::see_standard_attempts))
          << casedb::name_of(role) << " " << told;
  }
}

// A standard of 8 and then one of 9: 9·m9 − 8·m8 is what the ninth does. Before, everybody read both means, and z
// to the last digit, which with the value tells them as well.
TEST(AccessMatrix, ThePartsOfAStandardThatTellOnePersonAreAMentorsToRead) {
  FakeSite fake;
  assessment::ExpertSet& experts = fake.questions.grade.experts;
  experts.standard_id = "S-1";
  experts.people = 9;
  assessment::MetricBand band;
  band.id = "time_total";
  band.n = 9;
  band.low = 12.345;
  band.high = 67.89;
  band.mean = 31.23456;
  band.sd = 4.56789;
  band.tolerance = assessment::Interval{10.12345, 80.98765};
  experts.bands = {band};
  assessment::ScorePart part;
  part.id = "time_total";
  part.value = 40.0;
  part.mean = 31.23456;
  part.sd = 4.56789;
  part.z = 1.919;
  fake.questions.grade.score.parts = {part};
  for (const Role role : {Role::trainee, Role::mentor, Role::researcher, Role::director}) {
    FakeBrowser browser(*fake.site);
    browser.log_in_as(role);
    const std::string attempt = role == Role::trainee ? kOwnAttempt : kOthersAttempt;
    const std::string body = browser.get("/attempts/" + attempt + "/grade.json").body;
    const bool all = casedb::may(role, Action::see_standard_attempts);
    for (const char* told : {"31.23456", "4.56789", "1.919", "12.345", "10.12345"})
      EXPECT_EQ(body.find(told) != body.npos, all) << casedb::name_of(role) << " " << told;
    EXPECT_EQ(body.find("\"z\":1.9,") != body.npos, !all) << casedb::name_of(role);
    EXPECT_EQ(body.find("\"tolerance\":[10.0,81.0]") != body.npos, !all) << body;
    EXPECT_THAT(body, HasSubstr("\"people\":9")) << "of a standard that is set";
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

// Who reads which state of a case, written apart from the program.
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

}  // namespace
}  // namespace seldinger::web
