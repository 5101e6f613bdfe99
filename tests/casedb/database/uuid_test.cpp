// Ids of rows: the form of RFC 9562 version 7, the time within, and their order.
#include "casedb/database/uuid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <set>
#include <thread>
#include <vector>

namespace seldinger::casedb {
namespace {

TEST(UuidTest, HasTheFormOfVersion7) {
  for (int i = 0; i < 1000; ++i) {
    const std::string id = new_uuid();
    ASSERT_EQ(id.size(), 36U);
    for (std::size_t at = 0; at < id.size(); ++at)
      if (at == 8 || at == 13 || at == 18 || at == 23)
        EXPECT_EQ(id[at], '-');
      else
        EXPECT_NE(std::string("0123456789abcdef").find(id[at]), std::string::npos);
    EXPECT_EQ(id[14], '7');                                          // version
    EXPECT_NE(std::string("89ab").find(id[19]), std::string::npos);  // variant
  }
}

TEST(UuidTest, BeginsWithTheMilliseconds) {
  const auto clock_ms = [] {
    return std::chrono::duration_cast<std::chrono::milliseconds>(
               std::chrono::system_clock::now().time_since_epoch())
        .count();
  };
  const auto before_ms = clock_ms();
  const std::string id = new_uuid();
  const auto after_ms = clock_ms();
  const auto id_ms = std::stoll(id.substr(0, 8) + id.substr(9, 4), nullptr, 16);
  // now_us() runs ahead of the clock while it is asked more than once a microsecond.
  EXPECT_GE(id_ms, before_ms);
  EXPECT_LE(id_ms, after_ms + 100);
}

TEST(UuidTest, SortsInTheOrderOfMaking) {
  std::vector<std::string> ids;
  for (int i = 0; i < 20000; ++i) ids.push_back(new_uuid());
  EXPECT_TRUE(std::is_sorted(ids.begin(), ids.end()));
  EXPECT_EQ(std::set<std::string>(ids.begin(), ids.end()).size(), ids.size());
}

TEST(UuidTest, TimesOfAllThreadsDiffer) {
  std::vector<std::vector<std::int64_t>> times(4);
  std::vector<std::thread> threads;
  for (auto& own : times)
    threads.emplace_back([&own] {
      for (int i = 0; i < 5000; ++i) own.push_back(now_us());
    });
  for (auto& thread : threads) thread.join();
  std::set<std::int64_t> all;
  for (const auto& own : times) {
    EXPECT_TRUE(std::is_sorted(own.begin(), own.end()));
    all.insert(own.begin(), own.end());
  }
  EXPECT_EQ(all.size(), 20000U);
}

}  // namespace
}  // namespace seldinger::casedb
