// Where each role lands, and that it finds there what is its own to do and nothing else.
#include <gmock/gmock.h>

#include "tests/web/fake_site.h"

namespace seldinger::web {
namespace {

using casedb::Role;
using ::testing::HasSubstr;
using ::testing::Not;

const std::string kOther = "person-of-other-zzz999";

casedb::CurriculumRecord record_of(int misses, int item_passes) {
  casedb::CurriculumRecord record;
  record.curriculum.curriculum_id = "0190a1b2-0000-7000-8000-0000000000e1";
  record.curriculum.title = "First <year>";
  record.curriculum.items.resize(1);
  casedb::ItemState& item = record.items.emplace_back();
  item.title = "Liver";
  item.progress = {assessment::Proficiency::practising, true, true, {}};
  item.progress.passes_missing = 2;
  for (int i = 0; i < misses + item_passes; ++i) {
    assessment::GradedAttempt& one = item.graded.emplace_back();
    one.attempt_id = kOwnAttempt;
    one.started_us = 1'772'373'000'000'000 + i;
    one.verdict = i < item_passes ? assessment::Verdict::passed : assessment::Verdict::failed;
    if (i >= item_passes) one.missed = {"hit"};
  }
  item.attempts = misses + item_passes;
  item.passes = item_passes;
  return record;
}

TEST(Start, ATraineeReadsWhatIsDueWhatCameOfTheLastAttemptAndWhatWasSaidOfIt) {
  FakeSite fake;
  fake.questions.records["person-of-trainee"] = {record_of(1, 1)};
  fake.questions.grade.debrief = {{assessment::SentenceKind::well, "Hit the <target>.", "hit"}};
  fake.questions.comments = {{"c1", 12.5, "Breathe <out> first", "person-of-mentor", 1700000000000000}};
  FakeBrowser browser(*fake.site);
  browser.log_in_as(Role::trainee);
  const std::string page = browser.get("/").body;
  EXPECT_THAT(page, HasSubstr("Next: 1. <bdi>Liver</bdi>"));
  EXPECT_THAT(page, HasSubstr("It is due because"));
  EXPECT_THAT(page, HasSubstr("Hit the &lt;target&gt;."));
  EXPECT_THAT(page, HasSubstr("/attempts/" + kOwnAttempt));
  EXPECT_THAT(page, HasSubstr("Breathe &lt;out&gt; first"));
  EXPECT_THAT(page, Not(HasSubstr(kOthersAttempt)));
  EXPECT_THAT(page, Not(HasSubstr("Other Trainee")));
}

TEST(Start, ATraineeWithoutAnythingReadsThat) {
  FakeSite fake;
  fake.questions.attempts.clear();
  FakeBrowser browser(*fake.site);
  browser.log_in_as(Role::trainee);
  const Response response = browser.get("/");
  EXPECT_EQ(response.status, 200);
  EXPECT_THAT(response.body, HasSubstr("No curriculum is published yet"));
  EXPECT_THAT(response.body, HasSubstr("You have made no attempt yet"));
}

TEST(Start, WhoIsSimulatedIsCountedApart) {
  FakeSite fake;
  fake.questions.records[kOther] = fake.questions.records["one-drawn"] = {record_of(5, 0)};
  fake.questions.simulated.insert("one-drawn");
  fake.questions.cohorts = {
      {"c1", "Autumn", "", "", {{kOther, true, 5, 5, 0}, {"one-drawn", true, 0, 0, 0, true}}}};
  fake.questions.cohort_relations["person-of-mentor"]["c1"].own_cohort = true;
  fake.questions.relations["person-of-mentor"]["one-drawn"].own_cohort = true;
  FakeBrowser mentor(*fake.site);
  mentor.log_in_as(Role::mentor);
  EXPECT_THAT(mentor.get("/").body, HasSubstr("Stuck <strong>1</strong> and 1 simulated</a>"));
  const std::string learners = mentor.get("/progress").body;
  EXPECT_THAT(learners, HasSubstr("1 learner and 1 simulated. "));
  EXPECT_THAT(learners, HasSubstr("<dd>1<span class=\"why\"> and 1 simulated</span></dd>"));
  EXPECT_THAT(learners, HasSubstr("<caption>How many learners have")) << "item by item people alone";
  EXPECT_THAT(learners, HasSubstr("data-label=\"Stuck\">1</td>"));
  const std::string cohorts = mentor.get("/cohorts").body;
  EXPECT_THAT(cohorts, HasSubstr("<td data-label=\"Learners\">1: <bdi>Other Trainee</bdi> and 1 simulated: <bdi>"));
  fake.questions.cohorts[0].learners.erase(fake.questions.cohorts[0].learners.begin());
  EXPECT_THAT(mentor.get("/progress").body, HasSubstr("<caption>How many simulated learners have"));
}

TEST(Start, AMentorReadsWhoIsStuckOnWhatAndWhatWaits) {
  FakeSite fake;
  fake.questions.records[kOther] = {record_of(5, 0)};
  fake.questions.cohorts = {{"c1", "Autumn", "Radiology", "", {{kOther, true, 5, 5, 0}}}};
  fake.questions.cohort_relations["person-of-mentor"]["c1"].own_cohort = true;
  fake.questions.cohort_relations["person-of-director"]["c1"].own_programme = true;
  fake.questions.grade.grade.verdict = assessment::Verdict::failed;
  FakeBrowser mentor(*fake.site), director(*fake.site);
  mentor.log_in_as(Role::mentor);
  director.log_in_as(Role::director);
  const std::string page = mentor.get("/").body;
  EXPECT_THAT(page, HasSubstr("5 attempts running at 1. Liver"));
  EXPECT_THAT(page, HasSubstr("href=\"/progress/" + kOther + "\""));
  EXPECT_THAT(page, HasSubstr("standing=stuck\">Stuck <strong>1</strong>"));
  EXPECT_THAT(page, HasSubstr("standing=ready\">Ready <strong>0</strong>"));
  EXPECT_THAT(mentor.get("/progress").body, HasSubstr("<caption>How many learners have come how far"));
  EXPECT_THAT(page, HasSubstr("<bdi>Case, a review</bdi></a>: waits for your review"));
  EXPECT_THAT(page, Not(HasSubstr("Case, a draft")));
  EXPECT_THAT(page, HasSubstr("href=\"/attempts/" + kOthersAttempt + "\"")) << "not passed, nothing said";
  EXPECT_THAT(page, Not(HasSubstr(kNobodysAttempt)));
  // Once somebody has said something it no longer waits.
  fake.questions.comments = {{"c1", 12.5, "Breathe", "person-of-mentor", 1700000000000000}};
  EXPECT_THAT(mentor.get("/").body, Not(HasSubstr(kOthersAttempt)));
  const std::string directors = director.get("/").body;
  EXPECT_THAT(directors, HasSubstr("standing=stuck\">Stuck <strong>1</strong>"));
  EXPECT_THAT(directors, HasSubstr("A draft curriculum")) << "theirs to publish";
  EXPECT_THAT(page, Not(HasSubstr("A draft curriculum")));
}

// Who submitted a case does not approve it; the page says so instead of sending them to a refusal.
TEST(Start, AMentorIsNotSentToWhatTheySubmitted) {
  FakeSite fake;
  fake.questions.decisions = {{casedb::DecisionKind::submitted, "person-of-mentor", "m", "", 1}};
  FakeBrowser mentor(*fake.site), director(*fake.site);
  mentor.log_in_as(Role::mentor);
  director.log_in_as(Role::director);
  EXPECT_THAT(mentor.get("/").body, HasSubstr("a second person has to review it"));
  EXPECT_THAT(director.get("/").body, HasSubstr("waits for your review"));
}

// The charts of somebody's learning stand where how far they are does: for who may see that, and nobody else.
TEST(Progress, DrawsHowSomebodyLearnsForWhoMaySeeIt) {
  FakeSite fake;
  reports::LearnerItem item;
  item.title = "Liver <b>";
  for (int i = 0; i < 6; ++i) {
    casedb::LearningAttempt& one = item.attempts.emplace_back();
    one.started_us = 1'772'373'000'000'000 + i;
    one.verdict = i < 3 ? assessment::Verdict::failed : assessment::Verdict::passed;
  }
  reports::LearnerItem older = item;
  older.title = "Kidney";
  for (casedb::LearningAttempt& one : older.attempts) one.started_us -= 1'000;
  fake.questions.learning[kSomebody] = fake.questions.learning["person-of-trainee"] = {older, item};
  fake.questions.relations["person-of-mentor"][kSomebody].own_cohort = true;
  FakeBrowser trainee(*fake.site), mentor(*fake.site), researcher(*fake.site);
  trainee.log_in_as(Role::trainee);
  mentor.log_in_as(Role::mentor);
  researcher.log_in_as(Role::researcher);
  for (const std::string& page : {trainee.get("/progress").body, mentor.get("/progress/" + kSomebody).body}) {
    EXPECT_THAT(page, HasSubstr("open><summary><bdi>Liver &lt;b&gt;</bdi>")) << "the one at which they were last";
    EXPECT_THAT(page, HasSubstr("learned\"><summary><bdi>Kidney</bdi>"));
    EXPECT_THAT(page, HasSubstr("3 of 6 graded attempts passed"));
    EXPECT_THAT(page, HasSubstr("LC-CUSUM of failures"));
    EXPECT_THAT(page, HasSubstr("The charts as a table"));
  }
  EXPECT_EQ(researcher.get("/progress/" + kSomebody).status, 404);
  EXPECT_EQ(trainee.get("/progress/" + kSomebody).status, 404);
}

TEST(Start, AnAdminReadsHowTheServerStandsAndNothingOfPeoplesWork) {
  FakeSite fake;
  fake.questions.accounts[5].enabled = false;
  fake.questions.health_now = casedb::Health::full;
  FakeBrowser browser(*fake.site);
  browser.log_in_as(Role::admin);
  const std::string page = browser.get("/").body;
  EXPECT_THAT(page, HasSubstr("5 open, 1 closed"));
  EXPECT_THAT(page, HasSubstr("There is less room left"));
  EXPECT_THAT(page, HasSubstr("9.8.7"));
  EXPECT_THAT(page, Not(HasSubstr("/attempts/")));
}

}  // namespace
}  // namespace seldinger::web
