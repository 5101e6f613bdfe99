// What the pages tell, as JSON: of every page that lists people and things, to every role, the same names and no
// others.
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "tests/web/fake_site.h"

namespace seldinger::web {
namespace {

using casedb::Role;
using nlohmann::json;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr const char* kPages[] = {
    "/attempts", "/cases",   "/curricula", "/progress", "/cohorts",         "/studies", "/me",
    "/accounts", "/log-ins", "/audit",     "/stations", "/stations/timing", "/jobs"};

// Cohorts, learners, a study, consents and the log, so that each page has something to tell.
void fill_lists(FakeSite& fake) {
  casedb::Cohort own{"cohort-own", "Autumn", "Radiology", "", {{"person-of-other-zzz999", true, 3, 3, 2}}},
      others{"cohort-others", "Winter", "Surgery", "", {{"person-of-other-zzz999", true, 3, 3, 2}}};
  casedb::Cohort later = own;  // a learner in two of them: the page says in which
  later.cohort_id = "cohort-later";
  later.title = "Spring";
  fake.questions.cohorts = {own, others, later};
  for (const char* reader : {"person-of-mentor", "person-of-director"}) {
    for (const char* cohort : {"cohort-own", "cohort-later"}) {
      fake.questions.cohort_relations[reader][cohort].own_cohort = true;
      fake.questions.cohort_relations[reader][cohort].own_programme = true;
    }
  }
  fake.questions.told["cohort-own"];
  fake.questions.told["cohort-others"].cells = {-1, -1, -1, -1};
  fake.questions.records["person-of-other-zzz999"].emplace_back().curriculum.title = "First year";
  fake.questions.study_relations["person-of-researcher"][kStudy].own_study = true;
  fake.questions.about_me.consents.emplace_back().text_id = "text-1";
  fake.questions.about_me.consents[0].study_id = kStudy;
  fake.questions.about_me.consents[0].study_title = "Needles in phantoms";
  fake.questions.about_me.facts = {{"confidence", "4", 1700000000000000}};
  fake.questions.audit.rows = {{2, 1700000000000000, "person", "person-of-mentor", "log_in", "", "", "done", "ab"}};
  fake.questions.audit.names = {{"person-of-mentor", "mentor"}};
}

TEST(ListsJson, TellsEveryRoleTheSameNamesAsThePage) {
  int told = 0, compared = 0;
  for (const Role role : casedb::kAllRoles) {
    FakeSite fake;
    fill_lists(fake);
    FakeBrowser browser(*fake.site);
    ASSERT_EQ(browser.log_in_as(role).status, 303);
    for (const std::string path : kPages) {
      const Response page = browser.get(path), list = browser.get(path + ".json");
      const bool none_to_see = role == Role::admin && path == "/attempts";  // the page says so
      EXPECT_EQ(list.status, none_to_see ? 404 : page.status) << casedb::name_of(role) << path;
      if (list.status != 200) continue;
      EXPECT_EQ(list.content_type, "application/json");
      EXPECT_TRUE(json::accept(list.body)) << path << list.body.substr(0, 500);
      for (const char* name :
           {"Other Trainee", "Autumn", "Winter", "Spring", "Radiology", "Needles in phantoms", "First year",
            "Case of a1", "Case of a2", "Case of a3", "A draft curriculum", "A published curriculum",
            "A retired curriculum", "Case, a draft", "Case, a published", "Case, a retired"}) {
        const bool is_told = list.body.find(name) != list.body.npos;
        EXPECT_EQ(is_told, page.body.find(name) != page.body.npos)
            << casedb::name_of(role) << " " << path << " " << name;
        told += is_told ? 1 : 0;
        ++compared;
      }
    }
  }
  EXPECT_GT(told, 30);
  EXPECT_GT(compared, 300);
}

TEST(ListsJson, WhatPassingTellsIsToldAsOnThePage) {
  FakeSite fake;
  FakeBrowser browser(*fake.site);
  browser.log_in_as(Role::director);
  const json told = json::parse(browser.get("/curricula.json").body)["dependability"];
  EXPECT_TRUE(told["phi"].is_null()) << "nobody has attempted anything";
  EXPECT_THAT(browser.get("/curricula").body, HasSubstr(told["words"].get<std::string>()));
}

TEST(ListsJson, WhatIsWithheldIsNull) {
  FakeSite fake;
  fill_lists(fake);
  FakeBrowser browser(*fake.site);
  browser.log_in_as(Role::director);
  const json cohorts = json::parse(browser.get("/cohorts.json").body)["cohorts"];
  ASSERT_EQ(cohorts.size(), 3U);
  EXPECT_EQ(cohorts[0]["names"], json::array({"Other Trainee"}));
  EXPECT_EQ(cohorts[0]["attempts"], 3);
  for (const char* key : {"names", "learners", "attempts", "with_hit", "hits"})
    EXPECT_TRUE(cohorts[1][key].is_null()) << key;
}

TEST(ListsJson, HowFarSomebodyIsTellsEachAttempt) {
  FakeSite fake;
  fill_lists(fake);
  casedb::CurriculumRecord record;
  record.curriculum.curriculum_id = "curriculum-1";
  record.curriculum.title = "First year";
  casedb::ItemState& item = record.items.emplace_back();
  item.case_id = kPublishedCase;
  item.title = "Kidney";
  item.attempts = 1;
  item.progress.open = true;
  item.graded.push_back({kOwnAttempt, 1700000000000000, 31.5, assessment::Verdict::failed, {"hit"}});
  fake.questions.records["person-of-trainee"] = fake.questions.records["person-of-other-zzz999"] = {record};
  fake.questions.relations["person-of-trainee"]["person-of-trainee"].own = true;
  FakeBrowser trainee(*fake.site), mentor(*fake.site);
  trainee.log_in_as(Role::trainee);
  const json own = json::parse(trainee.get("/progress.json").body);
  EXPECT_EQ(own["person_id"], "person-of-trainee");
  const json& graded = own["curricula"][0]["items"][0]["graded"][0];
  EXPECT_EQ(graded["attempt_id"], kOwnAttempt);
  EXPECT_EQ(graded["duration_s"], 31.5);
  EXPECT_EQ(graded["verdict"], "failed");
  EXPECT_EQ(graded["missed"], json::array({"hit"}));
  mentor.log_in_as(Role::mentor);
  const json all = json::parse(mentor.get("/progress.json").body);
  ASSERT_EQ(all["learners"].size(), 1U);
  EXPECT_EQ(all["learners"][0]["name"], "Other Trainee");
  EXPECT_EQ(all["learners"][0]["curricula"][0]["title"], "First year");
}

TEST(ListsJson, AStudyTellsWhoIsInByPseudonymAndNoOutcome) {
  FakeSite fake;
  fill_lists(fake);
  reports::StudyView& study = fake.questions.studies[0];
  study.plan.emplace();
  study.plan->body = R"({"intended_use":"To tell"})";
  study.plan->frozen_us = 1700000000000000;
  study.plan->seed = "not told";
  study.flow.groups = {{"novices", 3, 1, 2, 2}};
  study.enrolments = {{"person-of-other-zzz999", "P-77", "novices", "", 0, 1700000000000000, true}};
  study.visits = {{"P-77", "first", 0, 1, casedb::VisitState::missed}};
  study.looks = {{1, 1700000000000000, "person", "R-1", "report validity", 7}};
  FakeBrowser browser(*fake.site);
  browser.log_in_as(Role::researcher);
  const std::string body = browser.get("/studies/" + kStudy + "/study.json").body;
  const json told = json::parse(body);
  EXPECT_EQ(told["plan"]["intended_use"], "To tell");
  EXPECT_EQ(told["enrolments"][0]["pseudonym"], "P-77");
  EXPECT_EQ(told["enrolments"][0]["enrolled_on"], "2023-11-14");
  EXPECT_EQ(told["visits"][0]["state"], "missed");
  EXPECT_EQ(told["looks"][0]["people"], 7);
  for (const char* hidden : {"zzz999", "Other Trainee", "not told"}) EXPECT_THAT(body, Not(HasSubstr(hidden)));
}

}  // namespace
}  // namespace seldinger::web
