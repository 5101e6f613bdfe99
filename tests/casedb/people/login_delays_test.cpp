// How fast passwords can be tried: five free, then doubling waits, for each name at each place.
#include "casedb/people/login_delays.h"

#include <gtest/gtest.h>

#include <chrono>

namespace seldinger::casedb {
namespace {

class LoginDelaysTest : public ::testing::Test {
 protected:
  void wait_s(std::int64_t s) { now_us_ += s * 1000000; }
  std::int64_t begin(std::string_view name, std::string_view place = "here") {
    return delays_.begin(name, place, now_us_);
  }
  std::int64_t now_us_ = 1;
  LoginDelays delays_;
};

TEST_F(LoginDelaysTest, FiveTriesAreFreeThenEachFailureDoublesTheWaitUpToAMinute) {
  for (int i = 0; i < 5; ++i) EXPECT_EQ(begin("ann"), 0) << i;
  for (const std::int64_t expected_s : {1, 2, 4, 8, 16, 32, 60, 60}) {
    EXPECT_EQ(begin("ann"), expected_s);
    wait_s(expected_s - 1);
    if (expected_s > 1) {
      EXPECT_EQ(begin("ann"), 1);
    }
    wait_s(1);
    EXPECT_EQ(begin("ann"), 0) << expected_s;
  }
}

TEST_F(LoginDelaysTest, CountsANameWithoutRegardToCaseAndApartFromOthers) {
  for (const char* name : {"ann", "ANN", "Ann", "aNN", "anN"}) EXPECT_EQ(begin(name), 0);
  EXPECT_GT(begin("ann"), 0);
  EXPECT_EQ(begin("bob"), 0);
}

TEST_F(LoginDelaysTest, ASuccessOrAnHourForgets) {
  for (int i = 0; i < 5; ++i) EXPECT_EQ(begin("ann"), 0);
  delays_.forget("Ann", "here");
  for (int i = 0; i < 5; ++i) EXPECT_EQ(begin("ann"), 0);
  EXPECT_GT(begin("ann"), 0);
  wait_s(3600);
  for (int i = 0; i < 5; ++i) EXPECT_EQ(begin("ann"), 0);
}

// Was: one count a name, so whoever knew it kept its owner out for as long as they liked, up to 15 min a time.
TEST_F(LoginDelaysTest, WhoFailsElsewhereShutsNobodyOut) {
  for (int second = 0; second < 600; ++second, wait_s(1)) begin("ann", "elsewhere");
  EXPECT_GT(begin("ann", "elsewhere"), 0);
  EXPECT_EQ(begin("ann", "here"), 0);
  // Nor does who gets in here let those in who fail there.
  delays_.forget("ann", "here");
  EXPECT_GT(begin("ann", "elsewhere"), 0);
}

TEST_F(LoginDelaysTest, WhoIsLetInAgainIsSoEverywhere) {
  for (int i = 0; i < 9; ++i) begin("ann", "here"), begin("ann", "there");
  EXPECT_EQ(delays_.longest_wait_s("ANN", now_us_), 1);
  delays_.forget("Ann");
  EXPECT_EQ(delays_.longest_wait_s("ann", now_us_), 0);
  EXPECT_EQ(begin("ann", "here"), 0);
  EXPECT_EQ(begin("ann", "there"), 0);
}

TEST_F(LoginDelaysTest, OneNameAtOnePlaceGetsFewerThanAHundredTriesAnHourHoweverItIsAsked) {
  int tries = 0;
  for (int second = 0; second < 3600; ++second, wait_s(1)) {
    for (int i = 0; i < 3; ++i) tries += begin("ann") == 0 ? 1 : 0;
  }
  EXPECT_GT(tries, 5);
  EXPECT_LT(tries, 100);
}

// Was: 60 tries of all names together, then one a second, successes counted too.
TEST_F(LoginDelaysTest, NamesThatNobodyHasDelayNobodyElseAndForgetNoLongWait) {
  for (int i = 0; i < 13; ++i, wait_s(60)) begin("ann");
  for (int i = 0; i < 25000; ++i) ASSERT_EQ(begin("nobody " + std::to_string(i)), 0) << i;
  EXPECT_EQ(begin("bob"), 0);
  begin("ann");
  EXPECT_GT(begin("ann"), 30) << "25,000 names later its failures are still known";
}

}  // namespace
}  // namespace seldinger::casedb
