// Consent, facts, erasing and cohorts as /me and /cohorts have them, and who reads names.
#include <gmock/gmock.h>

#include <vector>

#include "tests/web/fake_site.h"
#include "web/site/access.h"

namespace seldinger::web {
namespace {

using casedb::Relation;
using casedb::Role;
using ::testing::HasSubstr;
using ::testing::Not;

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
  EXPECT_THAT(browser.get("/me").body, HasSubstr("No study is asking for your consent."));
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
  // What was typed is there to be mended, and not typed again.
  const std::string again =
      browser.post("/me/facts", "confidence=11&logbook_total=44&handedness=left&token=" + token).body;
  EXPECT_THAT(again, HasSubstr("value=\"11\""));
  EXPECT_THAT(again, HasSubstr("value=\"44\""));
  EXPECT_THAT(again, HasSubstr("<option value=\"left\" selected>"));
  EXPECT_THAT(browser.get("/me").body, Not(HasSubstr("value=\"44\"")));
}

TEST(People, CohortsAreNamedToTheirMentorAndDirectorAndCountedToOtherDirectors) {
  FakeSite fake;
  const std::string other = "person-of-other-zzz999";
  fake.questions.cohorts = {{"c1", "Autumn", "Radiology", "", {{other, true, 13, 12, 7}}},
                            {"c2", "Spring", "Surgery", "", {{"stranger-1", true, 9, 9, 9}}},
                            {"c3", "Summer", "Surgery", "", {{"stranger-2", true, 7, 6, 4}}},
                            // Before, its title and its one learner's counts were told to both: all its learners
                            // are "seen" by them.
                            {"c4", "Remediation", "Surgery", "", {{other, true, 3, 2, 1}}},
                            // Before, gone for its own mentor.
                            {"c5", "Begins in May", "Radiology", "", {}}};
  fake.questions.told["c2"].cells = {6, 42, 30, 20};
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
  EXPECT_THAT(directors, HasSubstr("20 of 30")) << "as they are told, not as they are now";
  EXPECT_THAT(directors, Not(HasSubstr("9 of 9")));
  EXPECT_THAT(directors, HasSubstr("Summer"));
  EXPECT_THAT(directors, Not(HasSubstr("4 of 6"))) << "withheld";
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

}  // namespace
}  // namespace seldinger::web
