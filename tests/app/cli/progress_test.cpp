// What a terminal is told of a long command; that a pipe is told nothing: tests/e2e/cli_test.cpp.
#include "app/cli/progress.h"

#include <gtest/gtest.h>

namespace seldinger::app {
namespace {

TEST(Progress, TellsWhatIsLeftAtThePaceSoFar) {
  EXPECT_EQ(progress_text(0, 11, 5.0), "0 of 11") << "nothing is known yet";
  EXPECT_EQ(progress_text(3, 11, 15.0), "3 of 11, about 40 s");
  EXPECT_EQ(progress_text(10, 11, 12.0), "10 of 11, about 1 s");
  EXPECT_EQ(progress_text(1, 11, 0.7), "1 of 11, about 7 s");
  EXPECT_EQ(progress_text(1, 11, 13.4), "1 of 11, about 2 min");
  EXPECT_EQ(progress_text(2, 4, 88.0), "2 of 4, about 90 s");
  EXPECT_EQ(progress_text(11, 11, 60.0), "11 of 11");
}

}  // namespace
}  // namespace seldinger::app
