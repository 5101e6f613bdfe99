// Attempts as a course of learning: asked of one person they are what they are among everybody's.
#include "casedb/grading/learning.h"

#include <algorithm>
#include <set>

#include "casedb/database/audit.h"
#include "casedb/database/sqlite.h"
#include "casedb/people/simulated_people.h"
#include "tests/casedb/graded_library.h"

namespace seldinger::casedb {
namespace {

class LearningTest : public GradedLibrary {};

std::vector<std::string> ids_of(const std::vector<LearningAttempt>& attempts) {
  std::vector<std::string> ids;
  for (const LearningAttempt& one : attempts) ids.push_back(one.attempt_id);
  return ids;
}

TEST_F(LearningTest, OfOnePersonIsTheirPartOfEverybodys) {
  rule({"hit >= 1"});
  const std::string tom = user("Tom", Role::trainee), ann = user("Ann", Role::trainee);
  for (int i = 0; i < 3; ++i)
    for (const std::string& who : {tom, ann}) {
      NewAttempt one = new_attempt(who, i > 0 ? 1.0 : 0.0, 20.0);
      one.started_us += i * 1'000'000;
      ASSERT_TRUE(add_attempt(library_, one).has_value());
    }
  NewAttempt simulated = new_attempt(tom, 1.0, 20.0);
  simulated.operator_name = "expert";  // in Tom's name, and no deed of his
  ASSERT_TRUE(add_attempt(library_, simulated).has_value());
  attempt(std::nullopt, 1.0, 20.0);

  std::vector<LearningAttempt> all = learning_attempts(library_, Learners::people);
  EXPECT_EQ(all.size(), 6U);
  const std::vector<LearningAttempt> toms = learning_attempts_of(library_, tom);
  std::erase_if(all, [&](const LearningAttempt& one) { return one.person_id != tom; });
  EXPECT_EQ(ids_of(toms), ids_of(all));
  ASSERT_EQ(toms.size(), 3U);
  EXPECT_FALSE(toms[0].passed());
  EXPECT_TRUE(toms[2].passed());
  EXPECT_TRUE(std::is_sorted(toms.begin(), toms.end(),
                             [](const auto& a, const auto& b) { return a.started_us < b.started_us; }));
  EXPECT_EQ(toms[0].task.case_id, case_id_);
  EXPECT_EQ(toms[0].task.lesion_id, lesion_id_);
  EXPECT_TRUE(learning_attempts_of(library_, "nobody").empty());
}

// Who is simulated is said by the person, not by what was planted in them: that table may as well not be there.
TEST_F(LearningTest, OfSimulatedPeopleIsWhatTheyDidThemselves) {
  const auto drawn = assessment::population::drawn_person(*assessment::population::named_group("novice"), 7, 1);
  const std::string simulated = simulated_person(library_, drawn, 7), tom = user("Tom", Role::trainee);
  NewAttempt one = new_attempt(simulated, 1.0, 20.0);
  one.operator_name = "novice";
  const auto theirs = add_attempt(library_, one);
  ASSERT_TRUE(theirs.has_value());
  one.person_id = tom;  // in Tom's name
  ASSERT_TRUE(add_attempt(library_, one).has_value());
  attempt(tom, 1.0, 20.0);
  attempt(std::nullopt, 1.0, 20.0);
  library_.database().run("DROP TABLE simulated_truth");
  EXPECT_EQ(ids_of(learning_attempts(library_, Learners::simulated)), std::vector<std::string>{*theirs});
  EXPECT_EQ(ids_of(learning_verdicts(library_, Learners::simulated)), std::vector<std::string>{*theirs});
}

TEST_F(LearningTest, TheMarkIsAnotherOneByWhatConcernsItAlone) {
  const std::set<Act> concern = {Act::make_cohort,    Act::enrol,      Act::end_enrolment, Act::erase_person,
                                 Act::erase_attempts, Act::erase_case, Act::recompute,     Act::repair,
                                 Act::accept_damaged, Act::restore};
  for (std::size_t i = 0; i < kActs; ++i) {
    const Act act = static_cast<Act>(i);
    const LearningMark before = learning_mark(library_);
    Transaction transaction(library_.database());
    audit(library_, act, {"person", "somebody"});
    transaction.commit();
    const LearningMark after = learning_mark(library_);
    EXPECT_EQ(after.act != before.act, concern.contains(act)) << name_of(act);
    EXPECT_EQ(after.attempts, before.attempts);
  }
  const LearningMark before = learning_mark(library_);
  rule({"hit >= 1"});
  attempt(user("Tom", Role::trainee), 1.0, 20.0);
  EXPECT_NE(learning_mark(library_).attempts, before.attempts);
}

}  // namespace
}  // namespace seldinger::casedb
