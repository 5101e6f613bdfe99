// Tests of session/attempt/ordered_work.
#include "session/attempt/ordered_work.h"

#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>

#include "tests/fixtures/until.h"

namespace seldinger::session {
namespace {

TEST(InOrder, TakesInOrderWhateverTheThreads) {
  for (const std::size_t jobs : {1U, 2U, 7U}) {
    std::vector<std::size_t> taken;
    std::atomic<std::size_t> ahead{0}, most{0};
    in_order<std::size_t>(
        200, jobs,
        [&](std::size_t i) {
          std::size_t now = ++ahead, before = most;
          while (now > before && !most.compare_exchange_weak(before, now)) {
          }
          fixtures::let_pass(i % 10 == 0 ? 2e-3 : 1e-5);  // stands for work: the first are the slowest
          return i * i;
        },
        [&](std::size_t i, std::size_t made) {
          --ahead;
          EXPECT_EQ(made, i * i);
          taken.push_back(i);
          return true;
        });
    ASSERT_EQ(taken.size(), 200U);
    for (std::size_t i = 0; i < taken.size(); ++i) EXPECT_EQ(taken[i], i);
    EXPECT_LE(most, 4 * jobs + 1) << "few wait";
  }
}

TEST(InOrder, StopsWhenAskedTo) {
  std::size_t taken = 0;
  std::atomic<std::size_t> made{0};
  in_order<int>(
      1000, 3, [&](std::size_t) { return static_cast<int>(++made); },
      [&](std::size_t, int) { return ++taken < 10; });
  EXPECT_EQ(taken, 10U);
  EXPECT_LT(made, 100U);
  in_order<int>(
      0, 3, [](std::size_t) { return 1; }, [](std::size_t, int) { return true; });
}

TEST(InOrder, PassesOnWhatIsThrown) {
  EXPECT_THROW(in_order<int>(
                   50, 2,
                   [](std::size_t i) {
                     if (i == 20) throw std::runtime_error("made");
                     return 1;
                   },
                   [](std::size_t, int) { return true; }),
               std::runtime_error);
  EXPECT_THROW(in_order<int>(
                   50, 2, [](std::size_t) { return 1; },
                   [](std::size_t i, int) -> bool {
                     if (i == 20) throw std::runtime_error("taken");
                     return true;
                   }),
               std::runtime_error);
}

}  // namespace
}  // namespace seldinger::session
