// Simulated people's attempts from library to library: each once, whole, and nobody else's.
#include "casedb/attempts/merge_simulated.h"

#include <memory>
#include <thread>
#include <vector>

#include "casedb/attempts/add_unless.h"
#include "casedb/attempts/attempts.h"
#include "casedb/database/migrate.h"
#include "casedb/people/people.h"
#include "casedb/people/simulated_people.h"
#include "tests/casedb/library_samples.h"

namespace seldinger::casedb {
namespace {

namespace population = assessment::population;

population::Person novice(std::uint64_t number) {
  return population::drawn_person(*population::named_group("novice"), 7, number);
}

class MergeSimulatedTest : public testing::Test {
 protected:
  // Two libraries with the same case: the second is a copy of the first.
  MergeSimulatedTest() : folder_(fresh_folder()) {
    const auto& folder = folder_;
    {
      Library made = open_library(folder / "into");
      case_id_ = add_case(made, sample_case());
      lesion_id_ = add_lesion(made, case_id_, sample_lesion()).value();
      tina_ = add_user(made, "tina", Role::trainee, "a password").value();
    }
    std::filesystem::copy(folder / "into", folder / "from", std::filesystem::copy_options::recursive);
    into_ = std::make_unique<Library>(open_library(folder / "into"));
    from_ = std::make_unique<Library>(open_library(folder / "from"));
  }
  // An attempt of that person in one of the libraries.
  NewAttempt attempt_of(Library& library, const population::Person& person, std::uint64_t seed) const {
    NewAttempt made = sample_attempt(case_id_, lesion_id_);
    made.seed = seed;
    made.steps = {{"time_out", 1, assessment::StepState::done, 1.5, ""}};
    made.person_id = simulated_person(library, person, 7);
    return made;
  }
  std::filesystem::path folder_;
  std::string case_id_, lesion_id_, tina_;
  std::unique_ptr<Library> into_, from_;
};

TEST_F(MergeSimulatedTest, EachArrivesOnceAndWhole) {
  const NewAttempt first = attempt_of(*from_, novice(1), 11);
  add_attempt(*from_, first).value();
  add_attempt(*from_, attempt_of(*from_, novice(1), 12)).value();
  add_attempt(*from_, attempt_of(*from_, novice(2), 13)).value();
  // One of them was made here, too.
  add_attempt(*into_, attempt_of(*into_, novice(1), 11)).value();
  const auto merged = merge_simulated(*into_, *from_);
  ASSERT_TRUE(merged.has_value()) << merged.error().code;
  EXPECT_EQ(merged->people, 1U);
  EXPECT_EQ(merged->attempts, 2U);
  EXPECT_EQ(merged->there, 1U);
  EXPECT_EQ(list_simulated_truths(*into_).size(), 2U);
  EXPECT_EQ(list_simulated_truths(*into_)[1].ability, novice(2).ability);
  const auto attempts = list_attempts_of(*into_, simulated_person_id(novice(2)));
  ASSERT_EQ(attempts.size(), 1U);
  const auto sent = list_attempts_of(*from_, simulated_person_id(novice(2)));
  EXPECT_EQ(attempts[0].seed, 13U);
  EXPECT_TRUE(attempts[0].synthetic());
  ASSERT_EQ(attempts[0].metrics.size(), sent[0].metrics.size());
  for (std::size_t m = 0; m < sent[0].metrics.size(); ++m) {
    EXPECT_EQ(attempts[0].metrics[m].id, sent[0].metrics[m].id);
    EXPECT_EQ(attempts[0].metrics[m].version, sent[0].metrics[m].version);
    EXPECT_EQ(attempts[0].metrics[m].value, sent[0].metrics[m].value);
    EXPECT_EQ(attempts[0].metrics[m].reason, sent[0].metrics[m].reason);
  }
  EXPECT_EQ(attempts[0].started_us, sent[0].started_us);
  EXPECT_EQ(attempts[0].end, sent[0].end);
  EXPECT_EQ(attempts[0].picture_sha256, sent[0].picture_sha256);
  const auto steps = list_steps(*into_, attempts[0].attempt_id);
  ASSERT_EQ(steps.size(), 1U);
  EXPECT_EQ(steps[0].id, "time_out");
  const auto here = load_recording(*into_, attempts[0].attempt_id),
             there = load_recording(*from_, sent[0].attempt_id);
  ASSERT_TRUE(here.has_value() && there.has_value());
  EXPECT_EQ(difference(*here, *there), "");
  const auto again = merge_simulated(*into_, *from_);
  EXPECT_EQ(again->people + again->attempts, 0U);
  EXPECT_EQ(again->there, 3U);
  EXPECT_EQ(count_attempts(*into_), 3U);
}

// Of one shard at once, each through libraries of their own.
TEST_F(MergeSimulatedTest, TwoMergesAtOnceStoreNothingTwice) {
  constexpr std::uint64_t kAttempts = 12;
  for (std::uint64_t seed = 1; seed <= kAttempts; ++seed)
    add_attempt(*from_, attempt_of(*from_, novice(1 + seed % 3), seed)).value();
  std::vector<Merged> merged(2);
  std::vector<std::thread> threads;
  for (Merged& one : merged)
    threads.emplace_back([&] {
      Library into = open_library(folder_ / "into");
      auto from = open_to_merge(folder_ / "from");
      one = merge_simulated(into, *from).value();
    });
  for (std::thread& one : threads) one.join();
  EXPECT_EQ(count_attempts(*into_), kAttempts);
  EXPECT_EQ(merged[0].attempts + merged[1].attempts, kAttempts);
  EXPECT_EQ(merged[0].there + merged[1].there, kAttempts);
}

// Somebody else stored it between the look and the transaction.
TEST_F(MergeSimulatedTest, WhatIsThereByThenIsNotAdded) {
  const NewAttempt made = attempt_of(*into_, novice(1), 11);
  const auto added = add_attempt_unless(*into_, made, [] { return true; });
  ASSERT_TRUE(added.has_value());
  EXPECT_FALSE(added->has_value());
  EXPECT_EQ(count_attempts(*into_), 0U);
  EXPECT_TRUE(add_attempt_unless(*into_, made, [] { return false; }).value().has_value());
  EXPECT_EQ(count_attempts(*into_), 1U);
}

// A library of the schema before: it stays as it is, to the byte.
TEST_F(MergeSimulatedTest, AnOlderLibraryIsRefusedAndNotMigrated) {
  from_.reset();
  const auto folder = folder_ / "from";
  {
    std::filesystem::remove(folder / kDatabaseFile);
    Sqlite older(folder / kDatabaseFile, Sqlite::Mode::create);
    build(older, library_schema(), newest_version(library_schema()) - 1);
    EXPECT_EQ(older.text("PRAGMA journal_mode = WAL"), "wal");
  }
  const auto before = contents_of(folder);
  EXPECT_EQ(open_to_merge(folder).error().code, "older_schema");
  EXPECT_EQ(contents_of(folder), before);
  EXPECT_EQ(open_to_merge(folder_ / "nowhere").error().code, "no_library");
}

TEST_F(MergeSimulatedTest, TheOtherLibraryIsOnlyRead) {
  from_.reset();
  auto from = open_to_merge(folder_ / "from");
  ASSERT_TRUE(from.has_value());
  EXPECT_THROW(add_user(*from, "tom", Role::trainee, "a password"), base::Failure);
}

TEST_F(MergeSimulatedTest, NobodyElsesIsTaken) {
  NewAttempt tinas = sample_attempt(case_id_, lesion_id_);
  tinas.person_id = tina_;
  add_attempt(*from_, tinas).value();
  add_attempt(*from_, sample_attempt(case_id_, lesion_id_)).value();
  const auto merged = merge_simulated(*into_, *from_);
  ASSERT_TRUE(merged.has_value()) << merged.error().code;
  EXPECT_EQ(merged->people + merged->attempts + merged->there, 0U);
  EXPECT_EQ(count_attempts(*into_), 0U);
}

TEST_F(MergeSimulatedTest, OtherPeopleOrCasesAreRefusedAndNothingIsChanged) {
  add_attempt(*from_, attempt_of(*from_, novice(1), 11)).value();
  population::Person other = novice(1);
  other.ability[0] += 0.5;  // a group's file of the same name
  simulated_person(*into_, other, 7);
  EXPECT_EQ(merge_simulated(*into_, *from_).error().code, "person_differs");
  EXPECT_EQ(count_attempts(*into_), 0U);
}

TEST_F(MergeSimulatedTest, ACaseThatIsNotHereIsRefused) {
  NewAttempt made = attempt_of(*from_, novice(1), 11);
  made.case_id = add_case(*from_, sample_case("Kidney B"));
  made.lesion_id = add_lesion(*from_, made.case_id, sample_lesion()).value();
  add_attempt(*from_, made).value();
  EXPECT_EQ(merge_simulated(*into_, *from_).error().code, "no_case");
  EXPECT_TRUE(list_simulated_truths(*into_).empty());
}

// Somebody whose row says another seed than their id is made of.
TEST_F(MergeSimulatedTest, WhoIsNotWhoTheySayIsRefused) {
  simulated_person(*from_, novice(1), 8);
  EXPECT_EQ(merge_simulated(*into_, *from_).error().code, "damaged");
}

}  // namespace
}  // namespace seldinger::casedb
