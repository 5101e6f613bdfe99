// What mentors say of moments of an attempt.
#include "casedb/attempts/comments.h"

#include <cmath>

#include "casedb/database/sqlite.h"
#include "casedb/people/people.h"
#include "tests/casedb/library_samples.h"

namespace seldinger::casedb {
namespace {

TEST(Comments, AreKeptByTheirMomentsAndByWhoWrote) {
  Library library = open_library(fresh_folder() / "library");
  const std::string case_id = add_case(library, sample_case());
  const std::string lesion_id = add_lesion(library, case_id, sample_lesion()).value();
  const std::string mona = add_user(library, "mona", Role::mentor, "a password").value();
  const std::string attempt_id = add_attempt(library, sample_attempt(case_id, lesion_id)).value();
  const double ended_s = find_attempt(library, attempt_id)->duration_s;
  ASSERT_GT(ended_s, 0.1);
  library.act_for(Actor::person(mona));
  ASSERT_TRUE(add_comment(library, attempt_id, ended_s, "The tip has left the plane"));
  ASSERT_TRUE(add_comment(library, attempt_id, 0.05, "A good window"));
  for (const double moment : {-0.1, ended_s + 0.1, std::nan(""), HUGE_VAL}) {
    const auto refused = add_comment(library, attempt_id, moment, "x");
    ASSERT_FALSE(refused) << moment;
    EXPECT_EQ(refused.error().code, "bad_moment");
  }
  for (const std::string& body : {std::string(), std::string(" \n"), std::string(1001, 'a'), std::string("\xff")})
    EXPECT_EQ(add_comment(library, attempt_id, 0.0, body).error().code, "bad_text");
  EXPECT_EQ(add_comment(library, case_id, 0.0, "x").error().code, "no_attempt");
  const auto comments = list_comments(library, attempt_id);
  ASSERT_EQ(comments.size(), 2U);
  EXPECT_EQ(comments[0].body, "A good window");
  EXPECT_EQ(comments[1].at_s, ended_s);
  EXPECT_EQ(comments[1].person_id, mona);
  EXPECT_TRUE(refused_by_constraint([&] { library.database().run("UPDATE attempt_comment SET body = 'x'"); }));
}

}  // namespace
}  // namespace seldinger::casedb
