// Studies as who works on them reads them: people by pseudonym, no outcome, and a report only when asked.
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "tests/web/fake_site.h"

namespace seldinger::web {
namespace {

using namespace std::string_literals;
using casedb::Role;
using ::testing::HasSubstr;
using ::testing::Not;

casedb::StoredPlan stored_plan(bool frozen) {
  casedb::StoredPlan stored;
  stored.study_id = kStudy;
  stored.body_hash = std::string(64, 'b');
  stored.plan.intended_use = "To tell <novices> from experts";
  stored.plan.groups = {{"novices", {}, 1}, {"experts", {}, 1}};
  stored.plan.visits = {{"first", 0.0, 7.0}};
  stored.plan.primary.emplace_back();
  stored.plan.primary[0].name = "precision";
  stored.plan.primary[0].metric = "tip_target_dist";
  stored.plan.primary[0].case_id = kPublishedCase;
  stored.plan.per_group = 12;
  if (frozen) stored.frozen_us = 1700000000000000;
  return stored;
}

struct Studies : ::testing::Test {
  Studies() {
    fake.questions.study_relations["person-of-researcher"][kStudy].own_study = true;
    browser.log_in_as(Role::researcher);
  }
  FakeSite fake;
  FakeBrowser browser{*fake.site};
};

TEST_F(Studies, BeforeTheFreezeThereAreCountsOfAllTogether) {
  reports::StudyView& study = fake.questions.studies[0];
  study.plan = stored_plan(false);
  study.blinded = {{9, false}, 8, 77};
  const std::string page = browser.get("/studies/" + kStudy).body;
  EXPECT_THAT(page, HasSubstr("Needles in phantoms"));
  EXPECT_THAT(page, HasSubstr("To tell &lt;novices&gt; from experts"));
  EXPECT_THAT(page, HasSubstr("<dd>77</dd>"));
  EXPECT_THAT(page, HasSubstr("<dd>9 consent</dd>"));
  EXPECT_THAT(page, HasSubstr("is no look"));
  for (const char* later : {"By group", "Who is in", "Withdrew"}) EXPECT_THAT(page, Not(HasSubstr(later)));
}

TEST_F(Studies, AFrozenOneTellsWhoIsInByPseudonymAndWhoHasLooked) {
  reports::StudyView& study = fake.questions.studies[0];
  study.plan = stored_plan(true);
  study.flow.people = {9, false};
  study.flow.ever_enrolled = 4;
  study.flow.groups = {{"novices", 3, 1, 2, 2}, {"experts", 1, 0, 1, 1}};
  study.enrolments = {{"person-of-other-zzz999", "P-77", "novices", "", 0, 1700000000000000, true}};
  study.visits = {{"P-77", "first", 0, 1, casedb::VisitState::missed}};
  study.looks = {{1, 1700000000000000, "person", "R-1", "report <validity>", 7}};
  const std::string page = browser.get("/studies/" + kStudy).body;
  EXPECT_THAT(page, HasSubstr("Frozen on 2023-11-14"));
  EXPECT_THAT(page, HasSubstr("9 consent now, 4 were enrolled"));
  EXPECT_THAT(page, HasSubstr("<th scope=\"row\">P-77</th>"));
  EXPECT_THAT(page, HasSubstr("data-label=\"Missed\">1<"));
  EXPECT_THAT(page, HasSubstr("data-label=\"Due or missed by\">P-77<"));
  EXPECT_THAT(page, HasSubstr("report &lt;validity&gt;"));
  EXPECT_THAT(page, HasSubstr("of 7 people with an outcome"));
  EXPECT_THAT(page, HasSubstr("making it is a look"));
  for (const char* hidden : {"person-of-other", "Other Trainee", "zzz999"})
    EXPECT_THAT(page, Not(HasSubstr(hidden)));
  EXPECT_THAT(browser.get("/studies").body, HasSubstr("3 consent, 1 enrolled"));
  EXPECT_THAT(browser.get("/").body, HasSubstr("/studies/" + kStudy)) << "where a researcher lands";
}

TEST_F(Studies, OneOfSimulatedPeopleSaysSoWhereverItIsNamed) {
  for (const auto people : {assessment::study::People::real, assessment::study::People::simulated}) {
    fake.questions.studies[0].plan = stored_plan(true);
    fake.questions.studies[0].plan->plan.people = people;
    for (const std::string& path : {"/studies"s, "/studies/" + kStudy, "/"s})
      EXPECT_EQ(browser.get(path).body.find("<span class=\"mark\">simulated</span>") != std::string::npos,
                people == assessment::study::People::simulated)
          << path;
  }
}

// Nobody is asked whether a simulated person takes part.
TEST_F(Studies, SimulatedPeopleAreNotCountedAsConsenting) {
  reports::StudyView& study = fake.questions.studies[0];
  study.study.people = study.blinded.people = study.flow.people = {12, true};
  for (const bool frozen : {false, true}) {
    study.plan = stored_plan(frozen);
    study.plan->plan.people = assessment::study::People::simulated;
    study.enrolments = {{"person-of-other-zzz999", "S-77", "novices", "", 0, 1700000000000000, true}};
    const std::string page = browser.get("/studies/" + kStudy).body;
    EXPECT_THAT(page, HasSubstr("12 simulated people"));
    EXPECT_THAT(page, HasSubstr("of simulated people</dd>"));
    EXPECT_THAT(page, Not(HasSubstr("consent"))) << frozen;
    const auto told = nlohmann::json::parse(browser.get("/studies/" + kStudy + "/study.json").body);
    EXPECT_EQ(told["simulated"], 12);
    EXPECT_EQ(told[frozen ? "flow" : "so_far"]["simulated"], 12);
    EXPECT_EQ(told[frozen ? "flow" : "so_far"]["consenting"], 0);
  }
}

// Both are jobs (jobs_test.cpp), and of a plan that is not frozen nobody gets outcomes by person.
TEST_F(Studies, ReportAndExportAreAskedForAsJobs) {
  for (const bool frozen : {false, true}) {
    fake.questions.studies[0].plan = stored_plan(frozen);
    const std::string page = browser.get("/studies/" + kStudy).body;
    EXPECT_NE(form_token(page, "/jobs"), "");
    EXPECT_THAT(page, HasSubstr("name=\"kind\" value=\"study_report\""));
    EXPECT_EQ(page.find("name=\"kind\" value=\"study_export\"") != page.npos, frozen);
    EXPECT_THAT(page, HasSubstr("name=\"study\" value=\"" + kStudy + "\""));
  }
  EXPECT_EQ(fake.questions.done, std::vector<std::string>{}) << "to read is no look";
}

TEST_F(Studies, AnothersStudyIsByteForByteAMissingOne) {
  fake.questions.study_relations.clear();
  EXPECT_EQ(bytes_of(browser.get("/studies/" + kStudy), true),
            bytes_of(browser.get("/studies/" + kMissingAttempt), true));
  EXPECT_THAT(browser.get("/studies").body, Not(HasSubstr("Needles")));
  EXPECT_THAT(browser.get("/").body, Not(HasSubstr("Needles")));
}

}  // namespace
}  // namespace seldinger::web
