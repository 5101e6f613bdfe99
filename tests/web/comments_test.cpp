// Who says something of an attempt, and who reads it.
#include <gmock/gmock.h>

#include "tests/web/fake_site.h"

namespace seldinger::web {
namespace {

using casedb::Role;
using ::testing::HasSubstr;
using ::testing::Not;

TEST(Comments, AreSaidByTheMentorAndReadByTheTrainee) {
  FakeSite fake;
  for (casedb::AttemptRow& row : fake.questions.attempts) row.duration_s = 90.0;
  fake.questions.comments = {{"c1", 12.5, "Breathe <out> first", "person-of-mentor", 1700000000000000}};
  FakeBrowser mentor(*fake.site), director(*fake.site), researcher(*fake.site);
  mentor.log_in_as(Role::mentor);
  const std::string page = mentor.get("/attempts/" + kOthersAttempt).body;
  EXPECT_THAT(page, HasSubstr("At 12.5 s"));
  EXPECT_THAT(page, HasSubstr("Breathe &lt;out&gt; first"));
  const std::string action = "/attempts/" + kOthersAttempt + "/comments", token = form_token(page, action);
  ASSERT_FALSE(token.empty());
  EXPECT_EQ(mentor.post(action, "at=30.5&text=Stop+here&token=" + token).status, 303);
  EXPECT_EQ(fake.questions.done,
            std::vector<std::string>{"person-of-mentor says Stop here of " + kOthersAttempt + " at 30.500000"});
  EXPECT_EQ(mentor.post(action, "at=later&text=x&token=" + token).status, 400);
  EXPECT_EQ(mentor.post("/attempts/" + kNobodysAttempt + "/comments", "at=0&text=x&token=" + token).status, 404);

  FakeBrowser trainee(*fake.site);
  trainee.log_in_as(Role::trainee);
  const std::string own = trainee.get("/attempts/" + kOwnAttempt).body;
  EXPECT_THAT(own, HasSubstr("Breathe &lt;out&gt; first"));
  EXPECT_THAT(own, Not(HasSubstr("/comments\"")));
  director.log_in_as(Role::director);
  EXPECT_THAT(director.get("/attempts/" + kOthersAttempt).body, HasSubstr("At 12.5 s"));
  researcher.log_in_as(Role::researcher);
  EXPECT_THAT(researcher.get("/attempts/" + kOthersAttempt).body, Not(HasSubstr("Breathe"))) << "nothing typed";
}

}  // namespace
}  // namespace seldinger::web
