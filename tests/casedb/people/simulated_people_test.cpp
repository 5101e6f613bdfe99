// Simulated people in a library: the same in every one, never taken for people, and what was planted in them apart.
#include "casedb/people/simulated_people.h"

#include <fstream>
#include <sstream>

#include "casedb/attempts/attempt_history.h"
#include "casedb/attempts/attempts.h"
#include "casedb/database/sqlite.h"
#include "casedb/database/uuid.h"
#include "casedb/people/cohorts.h"
#include "casedb/people/facts.h"
#include "casedb/people/people.h"
#include "tests/casedb/library_samples.h"
#include "tests/fixtures/places.h"

namespace seldinger::casedb {
namespace {

namespace population = assessment::population;

population::Person novice(std::uint64_t number) {
  return population::drawn_person(*population::named_group("novice"), 7, number);
}

class SimulatedPeopleTest : public testing::Test {
 protected:
  Library library_ = open_library(fresh_folder() / "library");
  std::string kind_of(const std::string& person_id) {
    Statement row = library_.database().prepare("SELECT kind FROM person WHERE person_id = :id");
    return row.bind("id", person_id).step() ? row.text("kind") : "nobody";
  }
};

TEST_F(SimulatedPeopleTest, AreOnceInALibraryAndTheSameInEvery) {
  const std::string first = simulated_person(library_, novice(1), 7);
  EXPECT_TRUE(is_uuid(first));
  EXPECT_EQ(simulated_person(library_, novice(1), 7), first);
  EXPECT_NE(simulated_person(library_, novice(2), 7), first);
  Library other = open_library(fresh_folder() / "library");
  EXPECT_EQ(simulated_person(other, novice(1), 7), first);
  EXPECT_EQ(kind_of(first), "simulated");
  const auto truths = list_simulated_truths(library_);
  ASSERT_EQ(truths.size(), 2U);
  EXPECT_EQ(truths[0].person_id, first);
  EXPECT_EQ(simulated_people(library_), (std::set<std::string>{first, simulated_person(library_, novice(2), 7)}));
  EXPECT_EQ(truths[0].ability, novice(1).ability);
  EXPECT_EQ(truths[0].strategy, novice(1).strategy);
  EXPECT_EQ(truths[0].group, "novice");
  EXPECT_EQ(truths[0].seed, 7U);
  const auto facts = newest_facts(list_facts(library_, first));
  EXPECT_TRUE(facts.contains("years_in_radiology"));
  EXPECT_TRUE(facts.contains("handedness"));
  EXPECT_EQ(list_facts(library_, first).size(), 2U) << "told once";
}

TEST_F(SimulatedPeopleTest, AreNobodyWhoLogsInAndNothingOfTheirsIsAPersons) {
  const std::string simulated = simulated_person(library_, novice(1), 7);
  const std::string real = add_user(library_, "tina", Role::trainee, "a password").value();
  EXPECT_EQ(kind_of(real), "real");
  EXPECT_EQ(simulated_people(library_), std::set<std::string>{simulated});
  EXPECT_EQ(list_users(library_).size(), 1U);
  const std::string case_id = add_case(library_, sample_case());
  NewAttempt made = sample_attempt(case_id, add_lesion(library_, case_id, sample_lesion()).value());
  made.recording = sample_recording(50);
  made.person_id = simulated;
  made.operator_name = kPersonOperator;
  EXPECT_TRUE(refused_by_constraint([&] { (void)add_attempt(library_, made); }));
  made.operator_name = "novice";
  ASSERT_TRUE(add_attempt(library_, made));
  const auto rows = list_attempts_of(library_, simulated);
  ASSERT_EQ(rows.size(), 1U);
  EXPECT_TRUE(rows[0].synthetic());
  ASSERT_EQ(list_attempt_keys(library_).size(), 1U);
  EXPECT_TRUE(list_attempt_keys(library_)[0].of_simulated_person);
  for (const std::string& sql :
       {"UPDATE person SET kind = 'real' WHERE person_id = '" + simulated + "'",
        "UPDATE person SET kind = 'simulated' WHERE person_id = '" + real + "'",
        "INSERT INTO account (person_id, role, password_hash, enabled, created_us) VALUES ('" + simulated +
            "', 'trainee', '$argon2id$', 1, 0)",
        "INSERT INTO simulated_truth VALUES ('" + real + "', 1, 1, 'novice', 9, 0, 0, 0, 0, 0)",
        std::string("UPDATE simulated_truth SET eye_hand = 9")})
    EXPECT_TRUE(refused_by_constraint([&] { library_.database().run(sql); })) << sql;
}

TEST_F(SimulatedPeopleTest, LearnInACohortByAPseudonymThatSaysSo) {
  const std::string cohort = add_cohort(library_, "Simulated", "Radiology", "").value();
  ASSERT_TRUE(enrol(library_, cohort, simulated_person(library_, novice(1), 7), Post::learner));
  const auto enrolments = list_enrolments(library_, cohort);
  ASSERT_EQ(enrolments.size(), 1U);
  EXPECT_EQ(enrolments[0].pseudonym.substr(0, 2), "S-");
  EXPECT_TRUE(enrolments[0].simulated);
}

// What was planted is asked for by itself: no question names its table and another one.
TEST_F(SimulatedPeopleTest, WhatWasPlantedJoinsNothing) {
  std::size_t questions = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(fixtures::source_dir() / "casedb")) {
    if (entry.path().extension() != ".sql") continue;
    const std::string sql = fixtures::whole_file(entry.path());
    if (sql.find("simulated_truth") == sql.npos) continue;
    ++questions;
    for (const char* word : {"JOIN", "person\n", "attempt", "account", "enrolment", " FROM person"})
      EXPECT_EQ(sql.find(word), sql.npos) << entry.path() << ": " << word;
  }
  EXPECT_EQ(questions, 2U) << "one adds, one lists";
}

}  // namespace
}  // namespace seldinger::casedb
