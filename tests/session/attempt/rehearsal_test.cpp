// A rehearsal counts what the same operators come to when their attempts are stored and graded one by one, keeps
// nothing of it, and tells a rule that nobody meets.
#include "session/attempt/rehearsal.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "app/attempts/this_program.h"
#include "casedb/cases/authoring.h"
#include "casedb/cases/case_checks.h"
#include "casedb/cases/changeable_case.h"
#include "casedb/grading/grading.h"
#include "session/attempt/simulation.h"
#include "tests/fixtures/folders.h"
#include "tests/fixtures/new_ball.h"

namespace seldinger::session {
namespace {

class RehearsalTest : public testing::Test {
 protected:
  static constexpr std::size_t kPeople = 3;

  void SetUp() override {
    library_.emplace(std::move(casedb::Library::open_or_create(folder_).value()));
    case_id_ = casedb::add_case(*library_, fixtures::new_ball());
    ASSERT_TRUE(casedb::add_lesion(*library_, case_id_, fixtures::ball_target(25.0)));
  }
  void set_rule(std::initializer_list<const char*> criteria) {
    casedb::CaseSetting setting = casedb::find_case(*library_, case_id_).value();
    setting.rule.criteria.clear();
    for (const char* one : criteria) setting.rule.criteria.push_back(assessment::criterion_from(one).value());
    ASSERT_TRUE(casedb::set_setting(*library_, case_id_, setting));
  }
  Rehearsal rehearsed(RehearsalWish wish = {}) {
    wish.people = kPeople;
    auto found = rehearse(*library_, case_id_, wish);
    EXPECT_TRUE(found) << (found ? "" : found.error().text);
    return found ? *found : Rehearsal{};
  }

  std::filesystem::path folder_ = fixtures::fresh_test_folder("session") / "library";
  std::optional<casedb::Library> library_;
  std::string case_id_;
};

TEST_F(RehearsalTest, CountsWhatTheSameOperatorsComeToWhenTheyAreStored) {
  set_rule({"hit >= 1", "tip_target_dist <= 3"});
  const Rehearsal found = rehearsed();
  EXPECT_EQ(found.attempts(), 3 * kPeople);
  EXPECT_FALSE(found.stopped());
  EXPECT_EQ(found.content_mark, casedb::content_mark(*library_, case_id_));
  EXPECT_EQ(casedb::count_attempts(*library_), 0U) << "nothing is kept";
  EXPECT_TRUE(casedb::changeable_case(*library_, case_id_)) << "the draft can still be changed";

  auto simulation = Simulation::prepare(*library_, app::this_program(), case_id_, "");
  ASSERT_TRUE(simulation);
  casedb::Grader grader(*library_);
  std::size_t passed_in_all = 0;
  ASSERT_EQ(found.levels.size(), kRehearsedLevels.size());
  for (std::size_t level = 0; level < found.levels.size(); ++level) {
    const std::string name(kRehearsedLevels[level]);
    EXPECT_EQ(found.levels[level].operator_name, name);
    EXPECT_EQ(found.levels[level].attempts, kPeople);
    std::size_t passed = 0;
    const auto trials = simulated_trials(*assessment::named_profile(name), 1, 1, kPeople);
    ASSERT_TRUE(simulation->attempts(trials, 2, false, [&](const SimulatedAttempt& one) {
      const auto row = casedb::find_attempt(*library_, one.attempt_id);
      passed += grader.grade(*row).verdict == assessment::Verdict::passed ? 1U : 0U;
    }));
    EXPECT_EQ(found.levels[level].passed, passed) << name;
    passed_in_all += passed;
  }
  EXPECT_EQ(found.passed(), passed_in_all);
  EXPECT_GT(found.levels.back().passed, 0U) << "experts meet it";
  EXPECT_LT(found.passed(), found.attempts()) << "not everybody does: the count is of something";
}

TEST_F(RehearsalTest, IsTheSameOnAnyNumberOfThreads) {
  RehearsalWish wish;
  const Rehearsal one = rehearsed(wish);
  wish.jobs = 3;
  const Rehearsal three = rehearsed(wish);
  for (std::size_t level = 0; level < one.levels.size(); ++level)
    EXPECT_EQ(one.levels[level].passed, three.levels[level].passed);
  ASSERT_EQ(one.missed.size(), three.missed.size());
  for (std::size_t i = 0; i < one.missed.size(); ++i) EXPECT_EQ(one.missed[i].missed, three.missed[i].missed);
}

TEST_F(RehearsalTest, TellsARuleThatNobodyMeets) {
  set_rule({"hit >= 1", "skin_punctures <= 0"});  // a hit without a hole
  const Rehearsal found = rehearsed();
  EXPECT_EQ(found.passed(), 0U);
  ASSERT_FALSE(found.missed.empty());
  EXPECT_EQ(assessment::text_of(found.missed.front().of.criterion), "skin_punctures <= 0");
  EXPECT_EQ(found.missed.front().missed, found.attempts());
}

TEST_F(RehearsalTest, StopsWhenItIsToldTo) {
  std::size_t most = 0;
  RehearsalWish wish;
  wish.told = [&](std::size_t made, std::size_t of) {
    EXPECT_EQ(of, 3 * kPeople);
    most = made;
    return made < 4;
  };
  const Rehearsal found = rehearsed(wish);
  EXPECT_EQ(most, 4U);
  EXPECT_EQ(found.attempts(), 4U);
  EXPECT_TRUE(found.stopped());
  EXPECT_EQ(found.levels[0].attempts, 2U) << "in turn a person of every level";
  EXPECT_EQ(found.levels[2].attempts, 1U);
}

TEST_F(RehearsalTest, RefusesWhatCannotBeMet) {
  set_rule({});
  EXPECT_EQ(rehearse(*library_, case_id_, {}).error().code, "no_rule");
  EXPECT_EQ(rehearse(*library_, "nowhere", {}).error().code, "no_case");
}

}  // namespace
}  // namespace seldinger::session
