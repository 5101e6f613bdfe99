// What the server tells whoever watches over it: counts that add up, of nobody, to those on the machine and to
// admins.
#include "web/site/tally.h"

#include <gmock/gmock.h>

#include "tests/web/fake_site.h"

namespace seldinger::web {
namespace {

using casedb::Role;
using ::testing::HasSubstr;
using ::testing::Not;

TEST(Tally, CountsAnswersAndHowLongTheyTook) {
  Tally tally;
  tally.add("/a", 200, 5'000);  // at an end, which is its class's
  tally.add("/a", 200, 5'001);
  tally.add("/a", 404, 60'000'000);  // above all
  tally.add("", 404, 0);
  const std::string text = tally.text();
  for (const char* line :
       {"seldinger_answers_total{route=\"/a\",status=\"200\"} 2\n",
        "seldinger_answers_total{route=\"/a\",status=\"404\"} 1\n",
        "seldinger_answers_total{route=\"none\",status=\"404\"} 1\n",
        "seldinger_answer_seconds_bucket{route=\"/a\",le=\"0.005\"} 1\n",
        "seldinger_answer_seconds_bucket{route=\"/a\",le=\"0.01\"} 2\n",
        "seldinger_answer_seconds_bucket{route=\"/a\",le=\"30\"} 2\n",
        "seldinger_answer_seconds_bucket{route=\"/a\",le=\"+Inf\"} 3\n",
        "seldinger_answer_seconds_sum{route=\"/a\"} 60.01\n", "seldinger_answer_seconds_count{route=\"/a\"} 3\n"})
    EXPECT_THAT(text, HasSubstr(line));
}

TEST(Tally, IsToldOnTheMachineItselfAndToAdminsWithoutAnId) {
  FakeSite fake;
  FakeBrowser here(*fake.site), admin(*fake.site), mentor(*fake.site), anybody(*fake.site);
  admin.from = mentor.from = anybody.from = "192.0.2.7";
  admin.log_in_as(Role::admin);
  mentor.log_in_as(Role::mentor);
  EXPECT_EQ(mentor.get("/attempts/" + kOthersAttempt + "?a=secret").status, 200);
  for (FakeBrowser* one : {&mentor, &anybody}) EXPECT_EQ(one->get("/prometheus").status, 404);
  const Response told = here.get("/prometheus");
  ASSERT_EQ(told.status, 200);
  EXPECT_EQ(told.content_type, "text/plain; version=0.0.4; charset=utf-8");
  for (const char* line : {"seldinger_answers_total{route=\"/attempts/{attempt_id}\",status=\"200\"} 1\n",
                           "seldinger_answers_total{route=\"/login\",status=\"303\"} 2\n", "seldinger_sessions 2\n",
                           "seldinger_library_healthy 1\n", "seldinger_build_info{version=\"9.8.7\"} 1\n"})
    EXPECT_THAT(told.body, HasSubstr(line));
  for (const std::string& secret : {kOthersAttempt, std::string("secret"), std::string("mentor")})
    EXPECT_THAT(told.body, Not(HasSubstr(secret)));
  EXPECT_EQ(admin.get("/prometheus").status, 200);
  fake.questions.health_now = casedb::Health::full;
  EXPECT_THAT(here.get("/prometheus").body, HasSubstr("seldinger_library_healthy 0\n"));
  // Who came by the proxy is not on the machine, whatever the address that the proxy tells.
  fake.surroundings.public_authority = "sim.example.org";
  Request proxied = here.request("GET", "/prometheus");
  proxied.headers["host"] = "sim.example.org";
  EXPECT_EQ(here.send(proxied).status, 404);
}

}  // namespace
}  // namespace seldinger::web
