#include "sim/base/rows.h"

#include <gtest/gtest.h>

#include <mutex>
#include <set>

namespace seldinger::base {
namespace {

TEST(Rows, AreEachDoneOnceByAnyNumberOfThreads) {
  for (const int threads : {-1, 0, 1, 2, 7, 64})
    for (const int count : {0, 1, 2, 3, 100}) {
      std::vector<std::atomic<int>> done(static_cast<std::size_t>(count));
      over_rows(count, threads, [&](int row) { ++done[static_cast<std::size_t>(row)]; });
      for (const auto& one : done) EXPECT_EQ(one, 1) << threads << " threads, " << count << " rows";
    }
}

TEST(Rows, EachThreadHasScratchOfItsOwn) {
  struct Scratch {
    int rows = 0;
  };
  std::mutex mutex;
  std::set<const Scratch*> seen;
  std::atomic<int> made{0}, clashes{0};
  over_rows(
      1000, 4,
      [&] {
        ++made;
        return Scratch{};
      },
      [&](int, Scratch& scratch) {
        const int before = scratch.rows++;
        const std::lock_guard lock(mutex);
        seen.insert(&scratch);
        if (scratch.rows != before + 1) ++clashes;
      });
  EXPECT_EQ(made, 4);
  EXPECT_LE(seen.size(), 4U);
  EXPECT_EQ(clashes, 0);
}

TEST(Rows, NoMoreThreadsThanRows) {
  std::atomic<int> made{0};
  over_rows(
      3, 64,
      [&] {
        ++made;
        return 0;
      },
      [](int, int) {});
  EXPECT_EQ(made, 3);
}

}  // namespace
}  // namespace seldinger::base
