// The verdict of `doctor`.
#include "app/library/fitness.h"

#include <gtest/gtest.h>

namespace seldinger::app {
namespace {

constexpr Machine kDesk{.display = true, .gl = true, .software = false, .cores = 8, .disk_free_mb = 5000.0};

TEST(Fitness, ADeskWithAGraphicsCardTrains) {
  EXPECT_EQ(fitness_of(kDesk).fit, Fit::yes);
  EXPECT_TRUE(fitness_of(kDesk).why.empty());
}

TEST(Fitness, EveryReasonIsTold) {
  Machine slow = kDesk;
  slow.software = true;
  slow.cores = 1;
  EXPECT_EQ(fitness_of(slow).fit, Fit::slowly);
  EXPECT_EQ(fitness_of(slow).why.size(), 2U);
  Machine none = slow;
  none.display = none.gl = false;
  none.disk_free_mb = 3.4;
  EXPECT_EQ(fitness_of(none).fit, Fit::no);
  EXPECT_EQ(fitness_of(none).why,
            (std::vector<std::string>{"there is no display to open the window on", "OpenGL 4.3 is not available",
                                      "3 MB are free for attempts, of 26 that one of ten minutes may take"}))
      << "what would only slow it is beside the point";
}

TEST(Fitness, WhatIsNotKnownStopsNobody) {
  Machine unknown = kDesk;
  unknown.cores = 0;
  unknown.disk_free_mb.reset();
  EXPECT_EQ(fitness_of(unknown).fit, Fit::yes);
}

}  // namespace
}  // namespace seldinger::app
