// Sessions: they end by idleness, age and log-out, and their ids are not kept.
#include "web/site/sessions.h"

#include <gtest/gtest.h>

#include "tests/web/fake_site.h"

namespace seldinger::web {
namespace {

class SessionsTest : public ::testing::Test {
 protected:
  SessionsTest() {
    surroundings.now_us = [this] { return now_us; };
    surroundings.random_id = [this] { return "random-" + std::to_string(++ids); };
    surroundings.sha256_hex = fake_hash;
  }
  std::int64_t now_us = 5;
  int ids = 0;
  Surroundings surroundings;
  Sessions sessions{surroundings};
};

TEST_F(SessionsTest, EachHasItsOwnIdAndFormToken) {
  const std::string a = sessions.begin("ann"), b = sessions.begin("bob");
  EXPECT_NE(a, b);
  EXPECT_EQ(sessions.find(a)->person_id, "ann");
  EXPECT_EQ(sessions.find(b)->person_id, "bob");
  EXPECT_NE(sessions.find(a)->form_token, sessions.find(b)->form_token);
  EXPECT_FALSE(sessions.find("random-1x").has_value());
  EXPECT_FALSE(sessions.find("").has_value());
}

TEST_F(SessionsTest, TheHashUnderWhichItIsKeptOpensNothing) {
  const std::string id = sessions.begin("ann");
  EXPECT_FALSE(sessions.find(fake_hash(id)).has_value());
}

TEST_F(SessionsTest, EndsAfterThirtyMinutesWithoutUse) {
  const std::string id = sessions.begin("ann");
  now_us += kSessionIdle_us - 1;
  EXPECT_TRUE(sessions.find(id).has_value());  // used: the half hour begins anew
  now_us += kSessionIdle_us - 1;
  EXPECT_TRUE(sessions.find(id).has_value());
  now_us += kSessionIdle_us;
  EXPECT_FALSE(sessions.find(id).has_value());
  now_us -= kSessionIdle_us;
  EXPECT_FALSE(sessions.find(id).has_value());  // and stays ended
}

TEST_F(SessionsTest, EndsAfterTwelveHoursHoweverMuchItIsUsed) {
  const std::string id = sessions.begin("ann");
  const std::int64_t begun_us = now_us;
  while (now_us - begun_us < kSessionLife_us - kSessionIdle_us) {
    now_us += kSessionIdle_us / 2;
    ASSERT_TRUE(sessions.find(id).has_value());
  }
  now_us = begun_us + kSessionLife_us - 1;
  EXPECT_TRUE(sessions.find(id).has_value());
  now_us = begun_us + kSessionLife_us;
  EXPECT_FALSE(sessions.find(id).has_value());
}

TEST_F(SessionsTest, EndsByLogOutAlone) {
  const std::string a = sessions.begin("ann"), b = sessions.begin("ann"), c = sessions.begin("bob");
  sessions.end(a);
  EXPECT_FALSE(sessions.find(a).has_value());
  EXPECT_TRUE(sessions.find(b).has_value());
  EXPECT_TRUE(sessions.find(c).has_value());
}

TEST_F(SessionsTest, AreBoundedAndTheOldestMakesRoom) {
  const std::string first = sessions.begin("ann");
  for (std::size_t i = 1; i < kMaxSessionsOfOne; ++i) ++now_us, sessions.begin("ann");
  EXPECT_TRUE(sessions.find(first).has_value());
  ++now_us;
  const std::string last = sessions.begin("ann");
  EXPECT_FALSE(sessions.find(first).has_value());
  EXPECT_TRUE(sessions.find(last).has_value());
  for (std::size_t i = 0; i < kMaxSessions + 10; ++i) ++now_us, sessions.begin(std::to_string(i));
  EXPECT_EQ(sessions.count(), kMaxSessions);
}

}  // namespace
}  // namespace seldinger::web
