// When what a criterion counts happened, of a needle whose way is known.
#include "assessment/fault_moments.h"

#include <gtest/gtest.h>

#include "assessment/score.h"
#include "tests/assessment/metrics/sample_attempts.h"

namespace seldinger::assessment {
namespace {

// From 30 to 40 mm deep.
std::span<const cases::Structure> critical_ball() {
  static const std::vector<cases::Structure> all = [] {
    cases::Structure ball;
    ball.rule = cases::StructureRule::critical;
    ball.shape = cases::Sphere{{0.0, -35.0, 0.0}, 5.0};
    return std::vector{ball};
  }();
  return all;
}

// Straight down at these depths; no picture shows the tip; fired at the end.
Signals way_of(const std::vector<Knot>& depth_mm, double seconds) {
  StraightDown made = straight_down(depth_mm, seconds);
  made.setting.structures = critical_ball();
  return made.signals();
}

double time_of(const std::vector<FaultMoment>& faults, const char* metric, double at_most = 0.0) {
  const FaultMoment* found = find_fault(faults, metric, at_most);
  return found == nullptr ? -1.0 : found->t_s;
}

TEST(FaultMomentsTest, ThePunctureThatWasOneTooMany) {
  // In at 1 s, out at 3 s, in again at 5 s.
  const auto faults = fault_moments(
      way_of({{0.0, -10.0}, {1.0, 0.0}, {2.0, 20.0}, {3.0, -10.0}, {5.0, 0.0}, {6.0, 20.0}, {7.0, 20.0}}, 7.0));
  EXPECT_NEAR(time_of(faults, "skin_punctures", 0.0), 1.25, 0.1);
  EXPECT_NEAR(time_of(faults, "skin_punctures", 1.0), 5.25, 0.1) << "the second is the one too many";
  EXPECT_EQ(time_of(faults, "skin_punctures", 2.0), -1.0);
  EXPECT_EQ(find_fault(faults, "skin_punctures", 1.0)->words, "the skin was punctured");
  EXPECT_NEAR(time_of(faults, "withdrawals_full"), 2.0, 0.1) << "where the tip was deepest";
  EXPECT_NEAR(time_of(faults, "hit"), 7.0, 0.01);
  EXPECT_EQ(time_of(faults, "nogo_length_critical"), -1.0) << "it never came so deep";
  EXPECT_EQ(time_of(faults, "hand_in_beam"), -1.0) << "there is no beam";
}

TEST(FaultMomentsTest, WhereAStructureWasEnteredAndTheTipWentUnseen) {
  const auto faults = fault_moments(way_of({{0.0, -10.0}, {1.0, 0.0}, {7.0, 60.0}, {8.0, 60.0}}, 8.0));
  EXPECT_NEAR(time_of(faults, "nogo_length_critical", 0.0), 4.0, 0.15) << "30 mm deep";
  EXPECT_NEAR(time_of(faults, "nogo_contacts", 0.0), 4.0, 0.15);
  EXPECT_NEAR(time_of(faults, "blind_advance_max", 5.0), 1.0, 0.3) << "from the skin on, whatever the limit";
  EXPECT_EQ(time_of(faults, "nogo_length_major"), -1.0) << "there is none";
  EXPECT_EQ(time_of(faults, "time_total", 5.0), -1.0) << "no moment";
}

}  // namespace
}  // namespace seldinger::assessment
