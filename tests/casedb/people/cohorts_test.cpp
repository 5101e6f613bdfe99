// Cohorts, facts and consent: what comes back, what is refused, and what people are to each other by them.
#include "casedb/people/cohorts.h"

#include "assessment/population/person.h"
#include "casedb/attempts/attempts.h"
#include "casedb/database/credentials.h"
#include "casedb/database/sqlite.h"
#include "casedb/database/uuid.h"
#include "casedb/people/consent.h"
#include "casedb/people/facts.h"
#include "casedb/people/people.h"
#include "casedb/people/relations.h"
#include "casedb/people/simulated_people.h"
#include "casedb/people/told_cells.h"
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

// Was: void until the clock came there again; and what was ended while it was ahead went on meanwhile.
TEST_F(CohortsTest, WhatBeganOrEndedWhileTheClockWasAheadCounts) {
  const std::string study = add_study(library_, "Needles").value();
  ASSERT_TRUE(enrol(library_, cohort_, mona_, Post::mentor));
  ASSERT_TRUE(enrol(library_, cohort_, tina_, Post::learner));
  ASSERT_TRUE(appoint_director(library_, "Radiology", dora_));
  ASSERT_TRUE(add_researcher(library_, study, rita_));
  const std::string ahead_us = std::to_string(now_us() + 365 * 86'400'000'000);
  const auto set_all = [&](const std::string& column) {
    Transaction transaction(library_.database());
    for (const char* table : {"enrolment", "programme_director", "study_researcher"})
      library_.database().run(std::string("UPDATE ") + table + " SET " + column + " = " + ahead_us);
    transaction.commit();
  };
  const auto counts = [&] {
    return std::vector<bool>{to(mona_, tina_).own_cohort, to(dora_, tina_).own_programme,
                             relation_to_cohort(library_, mona_, cohort_, "Radiology").own_cohort,
                             relation_to_cohort(library_, dora_, cohort_, "Radiology").own_programme,
                             is_researcher_of(library_, study, rita_)};
  };
  set_all("from_us");
  EXPECT_EQ(counts(), std::vector<bool>(5, true));
  ASSERT_TRUE(enrol(library_, cohort_, tina_, Post::learner)) << "twice is once";
  EXPECT_EQ(list_enrolments(library_, cohort_).size(), 2U);
  set_all("to_us");
  EXPECT_EQ(counts(), std::vector<bool>(5, false));
}

// Was: 13 learners, of whom 12 were none; and who does not see them was told of five among whom one person hid.
TEST_F(CohortsTest, SimulatedLearnersAreCountedApart) {
  ASSERT_TRUE(enrol(library_, cohort_, tina_, Post::learner));
  std::string last;
  for (std::uint64_t number = 1; number <= 12; ++number) {
    const auto group = *assessment::population::named_group("novice");
    last = simulated_person(library_, assessment::population::drawn_person(group, 1, number), 1);
    ASSERT_TRUE(enrol(library_, cohort_, last, Post::learner));
  }
  for (const std::vector<Cohort>& cohorts : {list_cohorts(library_), list_members(library_)}) {
    EXPECT_EQ(cells_of(cohorts.at(0)).learners, 1);
    EXPECT_EQ(cells_of(cohorts.at(0)).simulated, 12);
  }
  const std::vector<CohortPast> pasts = list_cohort_pasts(library_);
  ASSERT_EQ(pasts.at(0).deeds.size(), 1U);
  EXPECT_EQ(pasts.at(0).deeds[0].person_id, tina_);
  ASSERT_TRUE(end_enrolment(library_, cohort_, last));
  EXPECT_EQ(cells_of(list_cohorts(library_).at(0)).simulated, 11);
  EXPECT_EQ(list_cohort_pasts(library_).at(0).deeds.size(), 1U) << "one who left is no deed of anybody's, either";
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

// Before, a title that is not UTF-8 was taken.
TEST_F(CohortsTest, ATitleIsText) {
  EXPECT_EQ(code(add_cohort(library_, "\xff", "Surgery", "")), "bad_title");
  EXPECT_EQ(code(add_study(library_, "\xff")), "bad_title");
}

TEST_F(CohortsTest, ACohortIsItsMentorsAndItsProgrammesDirectors) {
  ASSERT_TRUE(enrol(library_, cohort_, mona_, Post::mentor));
  ASSERT_TRUE(enrol(library_, cohort_, tina_, Post::learner));
  ASSERT_TRUE(appoint_director(library_, "Radiology", dora_));
  const std::string other = add_cohort(library_, "Remediation", "Surgery", "").value();
  ASSERT_TRUE(enrol(library_, other, tina_, Post::learner)) << "of whom both see everything";
  EXPECT_TRUE(relation_to_cohort(library_, mona_, cohort_, "Radiology").own_cohort);
  EXPECT_TRUE(relation_to_cohort(library_, dora_, cohort_, "Radiology").own_programme);
  for (const std::string& person : {mona_, dora_, tina_})
    EXPECT_EQ(relation_to_cohort(library_, person, other, "Surgery"), Relation()) << person;
  EXPECT_EQ(relation_to_cohort(library_, tina_, cohort_, "Radiology"), Relation()) << "a learner leads nothing";
  EXPECT_TRUE(relation_to_cohort(library_, dora_, "", "Radiology").own_programme) << "yet to be made";
  ASSERT_TRUE(end_enrolment(library_, cohort_, mona_));
  EXPECT_EQ(relation_to_cohort(library_, mona_, cohort_, "Radiology"), Relation());
}

// What somebody did before they came, or after they left, is no cohort's. Before, one enrolment added the
// newcomer's whole past to the sums, which told it.
TEST_F(CohortsTest, OnlyWhatWasDoneInACohortCounts) {
  const std::string case_id = add_case(library_, sample_case());
  const std::string lesion_id = add_lesion(library_, case_id, sample_lesion()).value();
  const auto attempt = [&](std::optional<double> hit) {
    NewAttempt made = sample_attempt(case_id, lesion_id);
    made.recording = sample_recording(20);
    made.person_id = tina_;
    made.operator_name = kPersonOperator;
    made.started_us = now_us();
    made.metrics = {{"hit", 1, hit, "bool", hit ? "" : "no_endpoint"}};
    ASSERT_TRUE(add_attempt(library_, made));
  };
  const auto cells = [&] { return cells_of(find_cohort(library_, cohort_).value()); };
  attempt(1.0);
  ASSERT_TRUE(enrol(library_, cohort_, tina_, Post::learner));
  EXPECT_EQ(cells(), (CohortCells{1, 0, 0, 0}));
  attempt(1.0);
  attempt(0.0);
  attempt(std::nullopt);
  EXPECT_EQ(cells(), (CohortCells{1, 3, 2, 1}));
  ASSERT_TRUE(end_enrolment(library_, cohort_, tina_));
  attempt(1.0);
  EXPECT_EQ(cells(), CohortCells()) << "she is not in it";
  const Cohort left = find_cohort(library_, cohort_).value();
  ASSERT_EQ(left.learners.size(), 1U) << "but what she did there stays in its sums";
  EXPECT_FALSE(left.learners[0].still);
  EXPECT_EQ(left.learners[0].attempts, 3);
}

// The clock was ahead when it was given, and was put right. Before, the withdrawal failed: "withdrawn_us >=
// given_us".
TEST_F(CohortsTest, WhatBeganInTheFutureCanBeEnded) {
  ASSERT_TRUE(add_consent_text(library_, std::nullopt, "May we?"));
  const std::string text = list_consents(library_, tina_).at(0).text_id, study = add_study(library_, "S").value();
  const std::string later = std::to_string(now_us() + 3'600'000'000);
  Sqlite& database = library_.database();
  database.run("INSERT INTO consent VALUES ('" + tina_ + "', '" + text + "', " + later + ", NULL)");
  database.run("INSERT INTO enrolment VALUES ('" + cohort_ + "', '" + tina_ + "', 'learner', " + later + ", NULL)");
  database.run("INSERT INTO programme_director VALUES ('Radiology', '" + dora_ + "', " + later + ", NULL)");
  database.run("INSERT INTO study_researcher VALUES ('" + study + "', '" + rita_ + "', " + later + ", NULL)");
  ASSERT_TRUE(withdraw_consent(library_, tina_, text));
  EXPECT_TRUE(consenting_people(library_, std::nullopt).empty());
  EXPECT_TRUE(end_enrolment(library_, cohort_, tina_));
  EXPECT_TRUE(end_director(library_, "Radiology", dora_));
  EXPECT_TRUE(end_researcher(library_, study, rita_));
}

// Given, withdrawn, and given again after the clock was put back. Before: told as withdrawn, while studies read it.
TEST_F(CohortsTest, TheConsentThatStandsIsTold) {
  ASSERT_TRUE(add_consent_text(library_, std::nullopt, "May we?"));
  const std::string text = list_consents(library_, tina_).at(0).text_id;
  library_.database().run("INSERT INTO consent VALUES ('" + tina_ + "', '" + text + "', 100, 110)");
  library_.database().run("INSERT INTO consent VALUES ('" + tina_ + "', '" + text + "', 50, NULL)");
  EXPECT_TRUE(list_consents(library_, tina_).at(0).stands());
  EXPECT_EQ(consenting_people(library_, std::nullopt), std::set{tina_});
}

// Before: `not_given`, so that nobody could leave one study whom the library's consent had brought into it.
TEST_F(CohortsTest, OneStudyIsRefusedThoughTheLibrarysConsentStands) {
  const std::string needles = add_study(library_, "Needles").value(),
                    probes = add_study(library_, "Probes").value();
  for (const auto& study : {std::optional<std::string>(), std::optional(needles), std::optional(probes)})
    ASSERT_TRUE(add_consent_text(library_, study, "May we?"));
  const auto of = [&](const std::optional<std::string>& study) {
    for (const Consent& one : list_consents(library_, tina_))
      if (one.study_id == study) return one;
    return Consent();
  };
  EXPECT_EQ(code(withdraw_consent(library_, tina_, of(needles).text_id)), "not_given") << "nothing covers it";
  ASSERT_TRUE(give_consent(library_, tina_, of({}).text_id));
  EXPECT_EQ(consenting_people(library_, needles), std::set{tina_});
  ASSERT_TRUE(withdraw_consent(library_, tina_, of(needles).text_id));
  EXPECT_TRUE(of(needles).refused());
  EXPECT_FALSE(of(needles).stands());
  EXPECT_TRUE(consenting_people(library_, needles).empty());
  EXPECT_EQ(consenting_people(library_, probes), std::set{tina_});
  EXPECT_EQ(code(withdraw_consent(library_, tina_, of(needles).text_id)), "not_given") << "once is enough";
  ASSERT_TRUE(give_consent(library_, tina_, of(needles).text_id));
  EXPECT_EQ(consenting_people(library_, needles), std::set{tina_});
  EXPECT_FALSE(of(needles).refused());
}

// Before: there was no end to it.
TEST_F(CohortsTest, AResearchersWorkOnAStudyEnds) {
  const std::string study = add_study(library_, "Needles").value();
  EXPECT_EQ(code(end_researcher(library_, study, rita_)), "not_enrolled");
  ASSERT_TRUE(add_researcher(library_, study, rita_));
  ASSERT_TRUE(end_researcher(library_, study, rita_));
  EXPECT_FALSE(is_researcher_of(library_, study, rita_));
  ASSERT_TRUE(add_researcher(library_, study, rita_));
  EXPECT_TRUE(is_researcher_of(library_, study, rita_)) << "and begins again";
}

TEST_F(CohortsTest, NoMoreProceduresAreIndependentThanThereWere) {
  EXPECT_EQ(code(give_facts(library_, tina_, {{"logbook_total", "3"}, {"logbook_independent", "9"}})),
            "bad_answer");
  ASSERT_TRUE(give_facts(library_, tina_, {{"logbook_total", "9"}, {"logbook_independent", "9"}}));
  EXPECT_EQ(code(give_fact(library_, tina_, "logbook_total", "3")), "bad_answer") << "beside what was said before";
  ASSERT_TRUE(give_facts(library_, tina_, {{"logbook_total", "10"}, {"logbook_independent", "2"}}));
  EXPECT_EQ(newest_facts(list_facts(library_, tina_)).at("logbook_total").answer, "10")
      << "as numbers, not as words";
  ASSERT_TRUE(give_fact(library_, tina_, "confidence", "4"));
}

TEST_F(CohortsTest, FactsAreStoredAllOrNone) {
  EXPECT_EQ(code(give_facts(library_, tina_, {{"confidence", "4"}, {"handedness", "up"}})), "bad_answer");
  EXPECT_TRUE(list_facts(library_, tina_).empty());
  EXPECT_EQ(code(give_facts(library_, "nobody", {{"confidence", "4"}})), "no_person");
  // One of them cannot be stored. Before, the first had been, in a transaction of its own.
  library_.database().run(
      "CREATE TRIGGER no_left BEFORE INSERT ON person_fact WHEN NEW.answer = 'left' BEGIN SELECT RAISE(ABORT, "
      "'no'); "
      "END");
  EXPECT_THROW(static_cast<void>(give_facts(library_, tina_, {{"confidence", "4"}, {"handedness", "left"}})),
               DatabaseFailure);
  EXPECT_TRUE(list_facts(library_, tina_).empty());
  ASSERT_TRUE(give_facts(library_, tina_, {{"confidence", "4"}, {"handedness", "right"}}));
  EXPECT_EQ(list_facts(library_, tina_).size(), 2U);
}

}  // namespace
}  // namespace seldinger::casedb
