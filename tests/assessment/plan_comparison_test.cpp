// What a trainee planned against what was done, of needles whose way is known.
#include "assessment/plan_comparison.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "tests/assessment/metrics/sample_attempts.h"

namespace seldinger::assessment {
namespace {

TEST(PlanComparisonTest, IsOfTheMomentInWhichItWasFired) {
  const auto done =
      done_path(straight_down({{0.0, -10.0}, {1.0, 0.0}, {3.0, 70.0}, {5.0, 40.0}, {6.0, 40.0}}, 6.0).signals());
  ASSERT_TRUE(done);
  EXPECT_NEAR(done->t_s, 6.0, 0.02) << "not when it was deepest";
  EXPECT_NEAR(done->path.depth_mm(), 40.0, 0.01);
  EXPECT_NEAR(glm::length(done->path.entry_lps_mm), 0.0, 0.01);
}

TEST(PlanComparisonTest, IsOfTheDeepestWhereNothingWasFiredOrTheNeedleWasOut) {
  const std::vector<Knot> out_again = {{0.0, -10.0}, {1.0, 0.0}, {3.0, 70.0}, {5.0, -10.0}, {6.0, -10.0}};
  StraightDown made = straight_down(out_again, 6.0);
  for (const bool fired : {true, false}) {
    if (!fired) made.recording.endpoint.reset();
    const auto done = done_path(made.signals());
    ASSERT_TRUE(done) << fired;
    EXPECT_NEAR(done->t_s, 3.0, 0.1);
    EXPECT_NEAR(done->path.depth_mm(), 70.0, 0.05);
  }
}

TEST(PlanComparisonTest, ANeedleThatWasNeverInHasDoneNothing) {
  EXPECT_FALSE(done_path(straight_down({{0.0, -10.0}, {2.0, -5.0}, {4.0, -5.0}}, 4.0).signals()));
}

TEST(PlanComparisonTest, TellsEntryAngleAndDepth) {
  // 3-4-5: from the entry 3 mm beside, straight down, of a plan that leans by arctan(3/4) over 50 mm.
  const PlannedPath planned{{0.0, 0.0, 0.0}, {30.0, -40.0, 0.0}}, done{{0.0, 0.0, 3.0}, {0.0, -44.0, 3.0}};
  const PlanComparison told = compare(planned, done);
  EXPECT_NEAR(told.entry_mm, 3.0, 1e-12);
  EXPECT_NEAR(told.planned_depth_mm, 50.0, 1e-12);
  EXPECT_NEAR(told.depth_mm, 44.0, 1e-12);
  EXPECT_NEAR(told.angle_deg, std::atan2(3.0, 4.0) * 180.0 / std::numbers::pi, 1e-12);
  EXPECT_NEAR(told.tip_mm, std::sqrt(900.0 + 16.0 + 9.0), 1e-12);
}

// Whatever the two are: nothing of it changes when the world is turned and shifted, nor, but for the depths, when
// they change places; an angle of a hundredth of a degree is told.
TEST(PlanComparisonTest, IsTheSameFromEverySide) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> some_mm(-80.0, 80.0);
  const auto some = [&] { return glm::dvec3(some_mm(random), some_mm(random), some_mm(random)); };
  for (int round = 0; round < 200; ++round) {
    const PlannedPath a{some(), some()}, b{some(), some()};
    const PlanComparison there = compare(a, b), back = compare(b, a);
    EXPECT_NEAR(there.entry_mm, back.entry_mm, 1e-9);
    EXPECT_NEAR(there.angle_deg, back.angle_deg, 1e-9);
    EXPECT_NEAR(there.tip_mm, back.tip_mm, 1e-9);
    EXPECT_NEAR(there.depth_mm, back.planned_depth_mm, 1e-9);
    const glm::dvec3 shift = some();
    const auto moved = [&](const glm::dvec3& p) { return glm::dvec3(-p.y, p.x, p.z) + shift; };
    const PlanComparison elsewhere =
        compare({moved(a.entry_lps_mm), moved(a.tip_lps_mm)}, {moved(b.entry_lps_mm), moved(b.tip_lps_mm)});
    EXPECT_NEAR(there.entry_mm, elsewhere.entry_mm, 1e-9);
    EXPECT_NEAR(there.angle_deg, elsewhere.angle_deg, 1e-9);
    EXPECT_NEAR(there.depth_mm, elsewhere.depth_mm, 1e-9);
    EXPECT_EQ(compare(a, a).angle_deg, 0.0);
  }
  const double little = 0.01 * std::numbers::pi / 180.0;
  EXPECT_NEAR(
      compare({{}, {0.0, 0.0, 50.0}}, {{}, {50.0 * std::sin(little), 0.0, 50.0 * std::cos(little)}}).angle_deg,
      0.01, 1e-9);
}

}  // namespace
}  // namespace seldinger::assessment
