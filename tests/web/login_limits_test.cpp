// How fast passwords can be tried: five free, then doubling waits; how many are hashed at once.
#include "web/login_limits.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <thread>
#include <vector>

namespace seldinger::web {
namespace {

class ThrottleTest : public ::testing::Test {
 protected:
  ThrottleTest() {
    surroundings.now_us = [this] { return now_us; };
  }
  void wait_s(std::int64_t s) { now_us += s * 1000000; }
  std::int64_t now_us = 1;
  Surroundings surroundings;
  LoginThrottle throttle{surroundings};
};

TEST_F(ThrottleTest, FiveTriesAreFreeThenEachFailureDoublesTheWait) {
  for (int i = 0; i < 5; ++i) EXPECT_EQ(throttle.begin("ann"), std::nullopt) << i;
  for (std::int64_t expected_s = 1; expected_s <= 512; expected_s *= 2) {
    EXPECT_EQ(throttle.begin("ann"), std::optional(expected_s));
    wait_s(expected_s - 1);
    if (expected_s > 1) {
      EXPECT_EQ(throttle.begin("ann"), std::optional<std::int64_t>(1));
    }
    wait_s(1);
    EXPECT_EQ(throttle.begin("ann"), std::nullopt) << expected_s;
  }
  EXPECT_EQ(throttle.begin("ann"), std::optional<std::int64_t>(900));  // a quarter of an hour at most
}

TEST_F(ThrottleTest, CountsANameWithoutRegardToCaseAndApartFromOthers) {
  for (const char* name : {"ann", "ANN", "Ann", "aNN", "anN"}) EXPECT_EQ(throttle.begin(name), std::nullopt);
  EXPECT_NE(throttle.begin("ann"), std::nullopt);
  EXPECT_EQ(throttle.begin("bob"), std::nullopt);
}

TEST_F(ThrottleTest, ASuccessOrAnHourForgets) {
  for (int i = 0; i < 5; ++i) EXPECT_EQ(throttle.begin("ann"), std::nullopt);
  throttle.succeeded("Ann");
  for (int i = 0; i < 5; ++i) EXPECT_EQ(throttle.begin("ann"), std::nullopt);
  EXPECT_NE(throttle.begin("ann"), std::nullopt);
  wait_s(3600);
  for (int i = 0; i < 5; ++i) EXPECT_EQ(throttle.begin("ann"), std::nullopt);
}

TEST_F(ThrottleTest, OneNameGetsFewerThanAHundredTriesAnHourHoweverItIsAsked) {
  int tries = 0;
  for (int second = 0; second < 3600; ++second, wait_s(1)) {
    for (int i = 0; i < 3; ++i) tries += throttle.begin("ann").has_value() ? 0 : 1;
  }
  EXPECT_GT(tries, 5);
  EXPECT_LT(tries, 100);
}

TEST_F(ThrottleTest, AllNamesTogetherGetSixtyTriesThenOneASecond) {
  int tries = 0;
  for (int i = 0; i < 500; ++i) tries += throttle.begin("name" + std::to_string(i)).has_value() ? 0 : 1;
  EXPECT_EQ(tries, 60);
  wait_s(10);
  for (int i = 0; i < 500; ++i) tries += throttle.begin("more" + std::to_string(i)).has_value() ? 0 : 1;
  EXPECT_EQ(tries, 70);
}

TEST(LoginGate, LetsTwoInEightWaitAndSendsTheRestAway) {
  LoginGate gate;
  std::atomic<int> inside = 0, most = 0, sent_away = 0, served = 0;
  std::atomic<bool> open = false;
  std::vector<std::thread> threads;
  for (int i = 0; i < 30; ++i) {
    threads.emplace_back([&] {
      const auto pass = gate.enter();
      if (!pass.has_value()) {
        ++sent_away;
        return;
      }
      const int now = ++inside;
      int seen = most.load();
      while (now > seen && !most.compare_exchange_weak(seen, now)) {
      }
      while (!open.load()) std::this_thread::yield();
      --inside;
      ++served;
    });
  }
  while (sent_away.load() < 20) std::this_thread::yield();
  EXPECT_EQ(inside.load(), 2);
  open = true;
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(sent_away.load(), 20);
  EXPECT_EQ(served.load(), 10);
  EXPECT_EQ(most.load(), 2);
}

}  // namespace
}  // namespace seldinger::web
