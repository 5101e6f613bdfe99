// What a case page holds, and what each role reads of it and of an attempt at it.
#include <gmock/gmock.h>

#include "reports/words/attempt_words.h"
#include "tests/web/fake_site.h"
#include "web/site/access.h"

namespace seldinger::web {
namespace {

using casedb::Role;
using ::testing::HasSubstr;
using ::testing::Not;

using casedb::Relation;

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
  EXPECT_THAT(page, HasSubstr("Target hit</th><td>yes</td>"));
  EXPECT_THAT(page, HasSubstr("at least 8 mm; not meeting this is a critical error"));
  EXPECT_THAT(page, HasSubstr("provisional"));
  EXPECT_THAT(page, HasSubstr("draft, version 1"));
  EXPECT_THAT(browser.get("/cases/" + kDraftCase + "/checks.json").body, HasSubstr("\"holds\":false"));
  EXPECT_THAT(browser.get("/cases/" + kDraftCase + "/case.json").body, HasSubstr("\"metric\":\"hit\""));
}

// Before, a researcher read titles, indication, allergy, notes and µs.
TEST(Cases, AResearcherReadsNoFreeTextAndNoTimeOfDay) {
  constexpr std::int64_t kStartedUs = 1'772'373'909'123'456;  // 2026-03-01 14:05:09
  for (const Role role : casedb::kAllRoles) {
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

}  // namespace
}  // namespace seldinger::web
