// That the parts of a surrogate's attempts are all of them, each once.
#include <gtest/gtest.h>

#include <cstddef>
#include <vector>

#include "app/population/open_surrogate.h"

namespace seldinger::app {
namespace {

TEST(SurrogateShards, AreAllPeopleEachOnce) {
  for (const std::size_t people : {60U, 61U, 3600U})
    for (const std::size_t shards : {1U, 2U, 7U, 60U}) {
      std::size_t next = 1;
      for (std::size_t shard = 1; shard <= shards; ++shard) {
        const Numbered part = numbered({shard, shards}, people);
        EXPECT_EQ(part.first, next) << people << " in " << shards;
        EXPECT_LE(part.count, people / shards + 1);
        EXPECT_GE(part.count, people / shards);
        next += part.count;
      }
      EXPECT_EQ(next, people + 1);
    }
}

}  // namespace
}  // namespace seldinger::app
