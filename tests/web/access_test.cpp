// Who sees what: every role on every route, for what is their own, another's, nobody's and missing.
#include "web/access.h"

#include <gmock/gmock.h>

#include <set>
#include <vector>

#include "reports/words/attempt_words.h"
#include "tests/web/fake_site.h"
#include "web/routes.h"

namespace seldinger::web {
namespace {

using casedb::Role;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr auto& kRoles = casedb::kAllRoles;
using casedb::Action;
using casedb::Relation;
using casedb::Subject;

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

// The site with one attempt of somebody who is this to the reader.
void give(FakeSite& fake, Role role, const Relation& relation) {
  const std::string reader = "person-of-" + casedb::name_of(role);
  const std::string other = "person-of-other-zzz999";
  fake.questions.relations.clear();
  fake.questions.relations[reader][relation.own ? reader : other] = relation;
  fake.questions.attempts = {attempt_row(
      kOwnAttempt, relation.nobodys ? std::nullopt : std::optional<std::string>(relation.own ? reader : other))};
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
        Relation own;
        own.own = true;
        const bool is_change = route.method == "POST";
        // A route without an id is about the reader, or a list that is filtered.
        const bool may = of_an_attempt ? casedb::may(role, *route.who.action, relation)
                                       : casedb::roles_that_may(*route.who.action).has(role) &&
                                             (!is_change || casedb::may(role, *route.who.action, own));
        const std::string path = filled(route.pattern, kOwnAttempt);
        const std::string words = casedb::name_of(role) + " " + words_of(relation) + path;
        if (is_change) {
          const std::string token = form_token(browser.get("/me").body, "/me/facts");
          fake.questions.done.clear();
          const int status =
              browser.post(path, "sure=yes&answer=give&text=x&person=person-of-trainee&token=" + token).status;
          EXPECT_EQ(status, may ? 303 : 404) << words;
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
  EXPECT_EQ(checks, 5 * 17 * (9 * 2 + 4 + 2));
  EXPECT_GT(allowed, 300) << "a site that answers nobody would pass an empty table";
}

TEST(AccessMatrix, RoutesWithoutAnActionAreThoseOfNoSecret) {
  std::set<std::string_view> without;
  for (const Route& route : routes())
    if (!route.who.action) without.insert(route.pattern);
  EXPECT_EQ(without, (std::set<std::string_view>{"/healthz", "/style.css", "/", "/login", "/logout", "/attempts",
                                                 "/metrics"}))
      << "a new route names its action";
}

TEST(AccessMatrix, LoggedOutEverythingButTheOpenRoutesIsClosed) {
  FakeSite fake;
  FakeBrowser browser(*fake.site);
  const std::set<std::string_view> open = {"/healthz", "/style.css", "/login"};
  for (const Route& route : routes()) {
    if (route.method != "GET") continue;
    for (const std::string& id : {kOwnAttempt, kMissingAttempt}) {
      browser.cookies.clear();
      const Response response = browser.get(filled(route.pattern, id));
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
    fake.questions.relations.clear();
    browser.log_in_as(role);
    for (const char* end : {"", "/picture.png", "/metrics.json", "/grade.json"}) {
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

// Before, a researcher read titles, indication, allergy, notes and µs.
TEST(Cases, AResearcherReadsNoFreeTextAndNoTimeOfDay) {
  constexpr std::int64_t kStartedUs = 1'772'373'909'123'456;  // 2026-03-01 14:05:09
  for (const Role role : kRoles) {
    if (role == Role::trainee) continue;  // sees no case, and no others' attempts
    const bool all = role != Role::researcher;
    FakeSite fake;
    FakeBrowser browser(*fake.site);
    Relation relation;
    relation.own_cohort = relation.own_programme = relation.own_study = true;
    give(fake, role, relation);
    fake.questions.attempts[0].started_us = kStartedUs;
    fake.questions.attempts[0].case_title = "Quagmire";
    fake.questions.attempts[0].case_id = kPublishedCase;
    for (casedb::CaseRow& row : fake.questions.cases) {
      row.title = "Quagmire";
      row.clinic.indication = "Quagmire at night";
      row.clinic.allergy = "to Quagmire";
    }
    browser.log_in_as(role);
    std::string pages;
    for (const std::string& path :
         {std::string("/cases"), "/cases/" + kPublishedCase, "/cases/" + kPublishedCase + "/case.json",
          std::string("/attempts"), "/attempts/" + kOwnAttempt, std::string("/curricula")})
      pages += browser.get(path).body;
    EXPECT_EQ(pages.find("Quagmire") != pages.npos, all) << casedb::name_of(role);
    if (role == Role::admin) continue;  // sees no attempt
    EXPECT_THAT(pages, HasSubstr("2026-03-01")) << casedb::name_of(role);
    EXPECT_EQ(pages.find("14:05") != pages.npos, all) << casedb::name_of(role);
    EXPECT_EQ(pages.find(reports::case_text(kPublishedCase)) != pages.npos, !all) << casedb::name_of(role);
  }
}

TEST(Cases, WhatIsWithheldOfACaseIsAllThatSomebodyTyped) {
  casedb::CaseParts parts;
  parts.row = case_row(kPublishedCase, casedb::CaseState::published);
  parts.decisions.resize(1);
  parts.decisions[0].note = "a note";
  parts.decisions[0].decided_us = 1'772'373'909'123'456;
  parts.structures.resize(1);
  parts.structures[0].name = "Mr Miller's vessel";
  casedb::CaseParts told = parts;
  withhold(Role::mentor, told);
  EXPECT_EQ(told.decisions[0].note, "a note");
  EXPECT_EQ(told.structures[0].name, "Mr Miller's vessel");
  EXPECT_EQ(told.decisions[0].decided_us, parts.decisions[0].decided_us);
  withhold(Role::researcher, told);
  EXPECT_EQ(told.decisions[0].note, "");
  EXPECT_EQ(told.structures[0].name, cases::name_of(parts.structures[0].rule));
  EXPECT_EQ(told.decisions[0].decided_us, 1'772'323'200'000'000) << "2026-03-01";
  casedb::AttemptRow simulated = attempt_row(kNobodysAttempt, std::nullopt);
  simulated.operator_name = "as Zebedee does it";
  withhold(Role::researcher, simulated);
  EXPECT_EQ(simulated.operator_name, "custom");
}

TEST(People, ConsentIsGivenWithdrawnAndDeletesOnlyWhenAsked) {
  FakeSite fake;
  FakeBrowser browser(*fake.site);
  browser.log_in_as(Role::trainee);
  casedb::Consent text;
  text.text_id = "text-1";
  text.body = "May we <b>use</b> it?\nYou decide.";
  text.body_hash = std::string(64, 'e');
  fake.questions.about_me.consents = {text};
  std::string page = browser.get("/me").body;
  EXPECT_EQ(fake.questions.asked_about, "person-of-trainee");
  EXPECT_THAT(page, HasSubstr("May we &lt;b&gt;use&lt;/b&gt; it?"));
  EXPECT_THAT(page, HasSubstr("You have not answered."));
  EXPECT_THAT(page, HasSubstr("I consent"));
  const std::string token = form_token(page, "/me/consent");
  EXPECT_EQ(browser.post("/me/consent", "text=text-1&answer=give&token=" + token).status, 303);
  fake.questions.about_me.consents[0].given_us = 1700000000000000;
  page = browser.get("/me").body;
  EXPECT_THAT(page, HasSubstr("You consented on 2023-11-14"));
  EXPECT_THAT(page, HasSubstr("Withdraw my consent"));
  EXPECT_EQ(browser.post("/me/consent", "text=text-1&answer=withdraw&token=" + token).status, 303);
  EXPECT_EQ(browser.post("/me/consent", "text=text-1&answer=withdraw&delete=yes&token=" + token).status, 303);
  EXPECT_EQ(fake.questions.done,
            (std::vector<std::string>{"person-of-trainee gives text-1", "person-of-trainee withdraws text-1",
                                      "person-of-trainee withdraws text-1", "erased person-of-trainee"}));
  fake.questions.done.clear();
  EXPECT_EQ(browser.post("/me/consent", "text=text-1&answer=other&token=" + token).status, 400);
  EXPECT_EQ(browser.post("/me/erase", "token=" + token).status, 400) << "the box is not ticked";
  EXPECT_EQ(browser.post("/me/consent", "text=text-1&answer=give&token=wrong").status, 403);
  EXPECT_EQ(fake.questions.done, std::vector<std::string>{});
}

// Before, the page said nothing, and of what could not be overwritten neither.
TEST(People, WhatWasDoneIsSaid) {
  FakeSite fake;
  FakeBrowser browser(*fake.site);
  browser.log_in_as(Role::trainee);
  const std::string token = form_token(browser.get("/me").body, "/me/facts");
  const auto told = [&](const std::string& path, const std::string& form) {
    return browser.get(header_of(browser.post(path, form + "&token=" + token), "Location")).body;
  };
  EXPECT_THAT(told("/me/consent", "text=x&answer=give"), HasSubstr("Noted: you consent."));
  EXPECT_THAT(told("/me/consent", "text=x&answer=withdraw"), HasSubstr("Noted: you do not consent."));
  EXPECT_THAT(told("/me/facts", "confidence=4"), HasSubstr("Saved."));
  fake.questions.erased.attempts = 17;
  EXPECT_THAT(told("/me/erase", "sure=yes"), HasSubstr("Attempts deleted: 17. They cannot be brought back."));
  fake.questions.erased.overwritten = false;
  EXPECT_THAT(told("/me/consent", "text=x&answer=withdraw&delete=yes"),
              HasSubstr("Attempts deleted: 17. Old bytes"));
  fake.questions.erased.overwritten = true;
  fake.questions.erased.kept_copies = 1;
  EXPECT_THAT(told("/me/erase", "sure=yes"), HasSubstr("Old bytes"));
  for (const char* odd :
       {"", "erased=", "erased=x", "erased=1x", "erased=99999999999999999999999", "saved1", "<b>"})
    EXPECT_THAT(browser.get(std::string("/me?") + odd).body, Not(HasSubstr("role=\"status\""))) << odd;
}

// Before, the only button was "I consent".
TEST(People, AStudyThatTheLibrarysConsentCoversCanBeRefused) {
  FakeSite fake;
  FakeBrowser browser(*fake.site);
  browser.log_in_as(Role::trainee);
  EXPECT_THAT(browser.get("/me").body, HasSubstr("Nothing asks for your consent."));
  casedb::Consent of_library, of_study;
  of_library.text_id = "text-1";
  of_library.body_hash = of_study.body_hash = std::string(64, 'e');
  of_study.text_id = "text-2";
  of_study.study_id = "study-1";
  fake.questions.about_me.consents = {of_library, of_study};
  EXPECT_THAT(browser.get("/me").body, Not(HasSubstr("Not for this study"))) << "nothing covers it";
  fake.questions.about_me.consents[0].given_us = 1700000000000000;
  EXPECT_THAT(browser.get("/me").body, HasSubstr("Not for this study"));
  fake.questions.about_me.consents[1].given_us = fake.questions.about_me.consents[1].withdrawn_us =
      1700000000000000;
  const std::string refused = browser.get("/me").body;
  EXPECT_THAT(refused, Not(HasSubstr("Not for this study")));
  EXPECT_THAT(refused, HasSubstr("You refused on 2023-11-14"));
}

TEST(People, FactsAreAskedByTheTableAndOnlyWhatChangedIsStored) {
  FakeSite fake;
  FakeBrowser browser(*fake.site);
  browser.log_in_as(Role::trainee);
  fake.questions.about_me.facts = {{"confidence", "4", 1700000000000000}};
  const std::string page = browser.get("/me").body;
  for (const casedb::FactInfo& fact : casedb::fact_infos())
    EXPECT_THAT(page, HasSubstr("name=\"" + std::string(fact.id) + "\""));
  const std::string token = form_token(page, "/me/facts");
  EXPECT_EQ(browser.post("/me/facts", "confidence=4&handedness=left&logbook_total=&token=" + token).status, 303);
  EXPECT_EQ(fake.questions.done, (std::vector<std::string>{"facts of person-of-trainee", "handedness = left"}));
  const Response refused = browser.post("/me/facts", "confidence=11&token=" + token);
  EXPECT_EQ(refused.status, 400);
  EXPECT_THAT(refused.body, HasSubstr("a whole number from 1 to 10"));
}

TEST(People, CohortsAreNamedToTheirMentorAndDirectorAndCountedToOtherDirectors) {
  FakeSite fake;
  const std::string other = "person-of-other-zzz999";
  const auto strangers = [](int count, int with_hit) {
    std::vector<casedb::Learner> all;
    for (int i = 0; i < count; ++i)
      all.push_back({"stranger-" + std::to_string(i), true, 7, i < with_hit ? 6 : 0, i < with_hit ? 4 : 0});
    return all;
  };
  fake.questions.cohorts = {{"c1", "Autumn", "Radiology", "", {{other, true, 13, 12, 7}}},
                            {"c2", "Spring", "Surgery", "", strangers(6, 5)},
                            {"c3", "Summer", "Surgery", "", strangers(6, 1)},
                            // Before, its title and its one learner's counts were told to both: all its learners
                            // are "seen" by them.
                            {"c4", "Remediation", "Surgery", "", {{other, true, 3, 2, 1}}},
                            // Before, gone for its own mentor.
                            {"c5", "Begins in May", "Radiology", "", {}}};
  for (const char* cohort : {"c1", "c5"}) {
    fake.questions.cohort_relations["person-of-mentor"][cohort].own_cohort = true;
    fake.questions.cohort_relations["person-of-director"][cohort].own_programme = true;
  }
  FakeBrowser mentor(*fake.site), director(*fake.site), trainee(*fake.site);
  mentor.log_in_as(Role::mentor);
  director.log_in_as(Role::director);
  trainee.log_in_as(Role::trainee);
  EXPECT_EQ(trainee.get("/cohorts").status, 404);
  const std::string mentors = mentor.get("/cohorts").body, directors = director.get("/cohorts").body;
  EXPECT_THAT(mentors, HasSubstr("Other Trainee"));
  EXPECT_THAT(mentors, HasSubstr("7 of 12"));
  EXPECT_THAT(mentors, Not(HasSubstr("Spring")));
  EXPECT_THAT(directors, HasSubstr("Other Trainee"));
  EXPECT_THAT(directors, HasSubstr("20 of 30")) << "five people are enough";
  EXPECT_THAT(directors, HasSubstr("Summer"));
  EXPECT_THAT(directors, Not(HasSubstr("4 of 6"))) << "one person's; before: told, since six had made attempts";
  EXPECT_THAT(mentors, Not(HasSubstr("Remediation")));
  EXPECT_THAT(directors, HasSubstr("Remediation"));
  for (const std::string& page : {mentors, directors}) {
    EXPECT_THAT(page, Not(HasSubstr("1 of 2"))) << "of one who is alone in another's cohort";
    EXPECT_THAT(page, HasSubstr("Begins in May"));
  }
  EXPECT_THAT(directors, Not(HasSubstr("stranger")));
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
  Relation seen;
  seen.own_cohort = true;
  const Relations relations = {{"0190-abcdef123456", seen}, {"x", seen}};
  const auto nobody = [](const std::string&) { return std::nullopt; };
  EXPECT_EQ(operator_label(Role::mentor, relations, attempt_row(kOwnAttempt, "0190-abcdef123456"), nobody),
            "Person 123456");
  EXPECT_EQ(operator_label(Role::mentor, relations, attempt_row(kOwnAttempt, "x"), nobody), "Person x");
  // An account's attempt that a simulated operator made is none of a person's.
  casedb::AttemptRow simulated = attempt_row(kOwnAttempt, "x");
  simulated.operator_name = "expert";
  EXPECT_EQ(operator_label(Role::mentor, relations, simulated, nobody), "Simulated expert");
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
  const Response picture = browser.get("/attempts/" + kOthersAttempt + "/picture.png");
  EXPECT_EQ(picture.content_type, "image/png");
  EXPECT_EQ(picture.body.size(), fake.questions.picture.size());
  const Response metrics = browser.get("/attempts/" + kOthersAttempt + "/metrics.json");
  EXPECT_EQ(metrics.content_type, "application/json");
  EXPECT_EQ(
      metrics.body,
      R"({"attempt_id":")" + kOthersAttempt +
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
  EXPECT_EQ(browser.get("/attempts/" + kOthersAttempt + "/picture.png").status, 500);
  fake.questions.attempts[1].picture_sha256.clear();
  EXPECT_EQ(browser.get("/attempts/" + kOthersAttempt + "/picture.png").status, 404);
}

}  // namespace
}  // namespace seldinger::web
