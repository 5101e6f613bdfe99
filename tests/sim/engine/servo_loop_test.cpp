// Tests of sim/engine/servo_loop: what is counted of late ticks, told without a clock; start, stop and no
// allocation, without a word on how punctual this machine is.
#include "sim/engine/servo_loop.h"

#include <gtest/gtest.h>

#include "tests/fixtures/allocations.h"
#include "tests/fixtures/until.h"

namespace seldinger::engine {
namespace {

constexpr std::int64_t kTick = 1'000'000;

TEST(ServoLoop, CountsWhatIsLateAndWhatIsMissed) {
  cases::ServoRecord record;
  EXPECT_EQ(account_for_begin(kTick, kTick + 50'000, -1, kTick, record), kTick) << "late, not missed";
  EXPECT_EQ(record.missed, 0U);
  EXPECT_EQ(record.period.n, 0U) << "the first has none";
  EXPECT_EQ(account_for_begin(2 * kTick, 5 * kTick + 200'000, kTick + 50'000, kTick, record), 5 * kTick);
  EXPECT_EQ(record.missed, 3U) << "those due at 2, 3 and 4 ms never began";
  EXPECT_EQ(account_for_begin(6 * kTick, 6 * kTick, 5 * kTick + 200'000, kTick, record), 6 * kTick);
  EXPECT_EQ(record.ticks, 3U);
  EXPECT_EQ(record.missed, 3U);
  EXPECT_EQ(record.ticks + record.missed, 6U) << "of the six that were due";
  EXPECT_EQ(record.latency.most_ns, 3'200'000U);
  EXPECT_EQ(record.latency.n, 3U);
  EXPECT_EQ(record.period.most_ns, 4'150'000U);
  EXPECT_EQ(record.period.n, 2U);
  // A tick that is one whole tick late is the next one.
  EXPECT_EQ(account_for_begin(7 * kTick, 8 * kTick, 6 * kTick, kTick, record), 8 * kTick);
  EXPECT_EQ(record.missed, 4U);
}

class Running : public testing::TestWithParam<bool> {};
INSTANTIATE_TEST_SUITE_P(ServoLoop, Running, testing::Values(false, true));

TEST_P(Running, TicksUntilItIsStoppedAndAllocatesNothing) {
  ServoSettings settings;
  settings.real_time = GetParam();
  std::atomic<int> ticks{0};
  std::atomic<long> first{0}, last{0};
  std::atomic<double> elapsed_s{0.0};
  ServoLoop loop(settings, [&](double since_s) {
    if (ticks == 10) first = fixtures::allocations();
    if (ticks == 40) last = fixtures::allocations();
    if (ticks < 40) elapsed_s = elapsed_s + since_s;
    ++ticks;
  });
  EXPECT_TRUE(fixtures::until([&] { return ticks > 40; }));
  loop.stop();
  EXPECT_EQ(first, last);
  EXPECT_GE(elapsed_s, 0.040 - 1e-3) << "40 ticks take at least 39 ms, however late they are";
  const int done = ticks;
  loop.stop();
  fixtures::let_pass(0.005);  // five ticks' time, in which none may come
  EXPECT_EQ(ticks, done) << "stopped is stopped";
  const cases::ServoRecord& record = loop.record();
  EXPECT_EQ(record.ticks, static_cast<std::uint64_t>(done));
  EXPECT_EQ(record.compute.n, record.ticks);
  EXPECT_EQ(record.latency.n, record.ticks);
  EXPECT_EQ(record.period.n, record.ticks - 1);
  if (!GetParam()) {
    EXPECT_EQ(record.scheduler, cases::ServoScheduler::other);
    EXPECT_FALSE(record.memory_locked);
  }
}

}  // namespace
}  // namespace seldinger::engine
