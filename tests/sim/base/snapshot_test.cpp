// Tests of sim/base/snapshot: whole values only, the newest, each once, in order.
#include "sim/base/snapshot.h"

#include <gtest/gtest.h>

#include <thread>

namespace seldinger::base {
namespace {

TEST(Snapshot, TheNewestOnce) {
  Snapshot<int> snapshot;
  EXPECT_FALSE(snapshot.take().has_value());
  snapshot.put(1);
  snapshot.put(2);
  EXPECT_EQ(snapshot.take(), 2);
  EXPECT_FALSE(snapshot.take().has_value());
  snapshot.put(3);
  EXPECT_EQ(snapshot.take(), 3);
}

struct Large {
  std::array<std::uint64_t, 200> words{};
};

TEST(Snapshot, NeverHalfOfOneAndHalfOfAnother) {
  Snapshot<Large> snapshot;
  constexpr std::uint64_t kLast = 200000;
  std::thread writer([&] {
    Large value;
    for (std::uint64_t n = 1; n <= kLast; ++n) {
      value.words.fill(n);
      snapshot.put(value);
    }
  });
  std::uint64_t last = 0, taken = 0, torn = 0, backwards = 0;
  while (last < kLast) {
    const auto value = snapshot.take();
    if (!value) continue;
    ++taken;
    for (const std::uint64_t word : value->words) torn += word != value->words[0] ? 1U : 0U;
    backwards += value->words[0] <= last ? 1U : 0U;
    last = value->words[0];
  }
  writer.join();
  EXPECT_EQ(torn, 0U);
  EXPECT_EQ(backwards, 0U);
  EXPECT_GT(taken, 0U);
}

}  // namespace
}  // namespace seldinger::base
