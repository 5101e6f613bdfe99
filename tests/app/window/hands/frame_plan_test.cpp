#include "app/window/hands/frame_plan.h"

#include <gtest/gtest.h>

namespace seldinger::app {
namespace {

constexpr double kBegan = 100.0;

double waited_s(std::optional<double> expected_after_s) {
  if (!expected_after_s) return wait_for_picture_until_s(std::nullopt, kBegan) - kBegan;
  return wait_for_picture_until_s(kBegan + *expected_after_s, kBegan) - kBegan;
}

TEST(FramePlan, NobodyWaitsForAPictureThatIsNotBeingMade) {
  EXPECT_LE(waited_s(std::nullopt), 0.0);
}

TEST(FramePlan, APictureThatComesInTimeIsWaitedForAndALittleLonger) {
  EXPECT_NEAR(waited_s(0.020), 0.025, 1e-9);
  EXPECT_NEAR(waited_s(0.040), 0.050, 1e-9);
}

TEST(FramePlan, TheWindowStaysAtFifteenFramesASecondWhateverThePictureTakes) {
  for (double after_s = 0.0; after_s < 1.0; after_s += 0.001) {
    EXPECT_LE(waited_s(after_s), kMostFrameS + 1e-9) << after_s;
    EXPECT_LT(waited_s(after_s), 1.0 / 15.0) << after_s;
  }
}

TEST(FramePlan, APictureThatComesTooLateIsNotWaitedForAtAll) {
  EXPECT_GT(waited_s(kMostFrameS - 0.001), 0.0);
  EXPECT_LE(waited_s(kMostFrameS + 0.001), 0.0);
  EXPECT_LE(waited_s(0.3), 0.0);
}

TEST(FramePlan, APictureThatIsOverdueIsNotWaitedForLongerThanItsLateness) {
  EXPECT_LE(waited_s(-0.5), 0.0);  // expected before the frame began
}

}  // namespace
}  // namespace seldinger::app
