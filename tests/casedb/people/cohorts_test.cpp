// Cohorts, facts and consent: what comes back, what is refused, and what people are to each other by them.
#include "casedb/people/cohorts.h"

#include "casedb/database/credentials.h"
#include "casedb/people/consent.h"
#include "casedb/people/facts.h"
#include "casedb/people/people.h"
#include "casedb/people/relations.h"
#include "tests/casedb/library_samples.h"

namespace seldinger::casedb {
namespace {

template <typename T>
std::string code(const base::Result<T>& result) {
  return result ? "none" : result.error().code;
}

class CohortsTest : public testing::Test {
 protected:
  Library library_ = open_library(fresh_folder() / "library");
  std::string user(const char* name, Role role) { return add_user(library_, name, role, "a password").value(); }
  std::string mona_ = user("mona", Role::mentor), tina_ = user("tina", Role::trainee),
              otto_ = user("otto", Role::trainee), dora_ = user("dora", Role::director),
              rita_ = user("rita", Role::researcher);
  std::string cohort_ = add_cohort(library_, "2026 autumn", "Radiology", "Preston").value();
  Relation to(const std::string& reader, const std::string& person) {
    return relation_to(library_, reader, person);
  }
};

TEST_F(CohortsTest, AMentorLeadsTheLearnersOfTheCohortAsLongAsBothBelongToIt) {
  ASSERT_TRUE(enrol(library_, cohort_, mona_, Post::mentor));
  ASSERT_TRUE(enrol(library_, cohort_, tina_, Post::learner));
  ASSERT_TRUE(enrol(library_, cohort_, tina_, Post::learner)) << "twice is once";
  EXPECT_EQ(list_enrolments(library_, cohort_).size(), 2U);
  EXPECT_TRUE(to(mona_, tina_).own_cohort);
  EXPECT_FALSE(to(mona_, otto_).own_cohort);
  EXPECT_FALSE(to(tina_, mona_).own_cohort) << "a learner leads nobody";
  EXPECT_TRUE(to(tina_, tina_).own);
  ASSERT_TRUE(end_enrolment(library_, cohort_, tina_));
  EXPECT_FALSE(to(mona_, tina_).own_cohort);
  EXPECT_EQ(code(end_enrolment(library_, cohort_, tina_)), "not_enrolled");
  ASSERT_TRUE(enrol(library_, cohort_, tina_, Post::learner));
  EXPECT_TRUE(to(mona_, tina_).own_cohort);
  ASSERT_TRUE(end_enrolment(library_, cohort_, mona_));
  EXPECT_FALSE(to(mona_, tina_).own_cohort);
}

TEST_F(CohortsTest, ADirectorHasTheLearnersOfTheProgramme) {
  ASSERT_TRUE(enrol(library_, cohort_, tina_, Post::learner));
  EXPECT_FALSE(to(dora_, tina_).own_programme);
  ASSERT_TRUE(appoint_director(library_, "Radiology", dora_));
  EXPECT_TRUE(to(dora_, tina_).own_programme);
  EXPECT_FALSE(to(dora_, otto_).own_programme);
  ASSERT_TRUE(end_director(library_, "Radiology", dora_));
  EXPECT_FALSE(to(dora_, tina_).own_programme);
}

TEST_F(CohortsTest, WhatCannotBeIsRefused) {
  EXPECT_EQ(code(add_cohort(library_, "2026 autumn", "Surgery", "")), "title_taken");
  EXPECT_EQ(code(add_cohort(library_, "", "Surgery", "")), "bad_title");
  EXPECT_EQ(code(add_cohort(library_, "two\nlines", "Surgery", "")), "bad_title");
  EXPECT_EQ(code(enrol(library_, cohort_, "nobody", Post::learner)), "no_person");
  EXPECT_EQ(code(enrol(library_, "nothing", tina_, Post::learner)), "no_cohort");
  EXPECT_EQ(code(end_director(library_, "Radiology", dora_)), "not_enrolled");
}

TEST_F(CohortsTest, ConsentIsGivenWithdrawnAndOfOneStudyOrTheLibrary) {
  const std::string needles = add_study(library_, "Needles").value(),
                    probes = add_study(library_, "Probes").value();
  for (const auto& study : {std::optional(needles), std::optional(probes), std::optional<std::string>()})
    ASSERT_EQ(add_consent_text(library_, study, "May we?").value(), 1);
  ASSERT_TRUE(add_researcher(library_, needles, rita_));
  const auto text_of = [&](const std::optional<std::string>& study) {
    for (const Consent& one : list_consents(library_, tina_))
      if (one.study_id == study && one.newest) return one.text_id;
    return std::string();
  };
  EXPECT_FALSE(to(rita_, tina_).own_study);
  ASSERT_TRUE(give_consent(library_, tina_, text_of(needles)));
  ASSERT_TRUE(give_consent(library_, tina_, text_of(needles))) << "it stands already";
  EXPECT_TRUE(to(rita_, tina_).own_study);
  EXPECT_FALSE(to(rita_, otto_).own_study);
  EXPECT_EQ(consenting_people(library_, probes), std::set<std::string>{});
  ASSERT_TRUE(withdraw_consent(library_, tina_, text_of(needles)));
  EXPECT_FALSE(to(rita_, tina_).own_study);
  EXPECT_EQ(code(withdraw_consent(library_, tina_, text_of(needles))), "not_given");
  ASSERT_TRUE(give_consent(library_, tina_, text_of(std::nullopt)));
  EXPECT_FALSE(to(rita_, tina_).own_study) << "withdrawn from this study, though the library's stands";
  EXPECT_EQ(consenting_people(library_, probes), std::set{tina_});
  EXPECT_EQ(consenting_people(library_, std::nullopt), std::set{tina_});
  ASSERT_TRUE(give_consent(library_, tina_, text_of(needles)));
  EXPECT_TRUE(to(rita_, tina_).own_study) << "given again";
  // A new wording is asked for again; what was consented to stands until it is withdrawn.
  ASSERT_EQ(add_consent_text(library_, needles, "May we, in other words?").value(), 2);
  EXPECT_TRUE(to(rita_, tina_).own_study);
  const std::string newer = text_of(needles);
  EXPECT_EQ(list_consents(library_, tina_).size(), 4U);
  ASSERT_TRUE(withdraw_consent(library_, tina_, newer)) << "of every version";
  EXPECT_FALSE(to(rita_, tina_).own_study);
  EXPECT_EQ(code(give_consent(library_, tina_, "no such text")), "no_text");
  EXPECT_EQ(code(add_consent_text(library_, std::nullopt, "")), "bad_text");
  EXPECT_EQ(code(add_study(library_, "Needles")), "title_taken");
  EXPECT_EQ(list_consents(library_, otto_).at(0).body_hash,
            sha256_hex(std::as_bytes(std::span(std::string_view("May we?")))));
}

TEST_F(CohortsTest, FactsAreCheckedAndKeptWithTheirTimes) {
  EXPECT_EQ(code(give_fact(library_, tina_, "shoe_size", "42")), "unknown_fact");
  for (const char* answer : {"0", "11", "5.5", "", "five", "nan", "1e999", " 5"})
    EXPECT_EQ(code(give_fact(library_, tina_, "confidence", answer)), "bad_answer") << answer;
  EXPECT_EQ(code(give_fact(library_, tina_, "handedness", "up")), "bad_answer");
  EXPECT_EQ(code(give_fact(library_, "nobody", "handedness", "left")), "no_person");
  ASSERT_TRUE(give_fact(library_, tina_, "confidence", "4"));
  ASSERT_TRUE(give_fact(library_, tina_, "years_in_radiology", "1.50"));
  ASSERT_TRUE(give_fact(library_, tina_, "confidence", "6"));
  const auto given = list_facts(library_, tina_);
  ASSERT_EQ(given.size(), 3U) << "a later answer replaces none";
  EXPECT_LT(given[0].given_us, given[2].given_us);
  EXPECT_EQ(newest_facts(given).at("confidence").answer, "6");
  EXPECT_EQ(newest_facts(given).at("years_in_radiology").answer, "1.5");
  for (const FactInfo& fact : fact_infos()) {
    EXPECT_EQ(find_fact(fact.id), &fact);
    EXPECT_TRUE(fact.is_choice() || fact.least < fact.most) << fact.id;
  }
}

TEST_F(CohortsTest, SmallCellsAreWithheld) {
  Cohort cohort{"id", "t", "p", "", 5, 40, 5, 30, 20};
  EXPECT_EQ(suppressed(cohort).attempts, 40);
  EXPECT_EQ(suppressed(cohort).hits, 20);
  cohort.people_with_attempts = 4;
  EXPECT_EQ(suppressed(cohort).learners, 5);
  EXPECT_EQ(suppressed(cohort).attempts, -1);
  cohort = {"id", "t", "p", "", 4, 40, 5, 30, 20};
  EXPECT_EQ(suppressed(cohort).learners, -1);
  EXPECT_EQ(suppressed(cohort).attempts, -1);
  EXPECT_EQ(suppressed(cohort).hits, -1);
}

}  // namespace
}  // namespace seldinger::casedb
