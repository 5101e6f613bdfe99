// Tests of sim/devices/arms/arm_check on a hand and device of the bench.
#include "sim/devices/arms/arm_check.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <vector>

#include "sim/haptics/hand_rig.h"

namespace seldinger::devices {
namespace {

// An arm with somebody's hand on it, who leads it as far as is asked and then holds it.
struct Arm {
  explicit Arm(const char* hand = "light") {
    for (int i = 0; i < 3; ++i)
      axes.emplace_back(*haptics::find_arm_model("inverse3"), *haptics::find_hand(hand), 0.0, 0.0);
  }
  // Motors by axis: which of its axes a told one drives, and which way round.
  int order[3] = {0, 1, 2};
  double sign[3] = {1.0, 1.0, 1.0};
  double round_trip_s = 0.001, reach_mm = 130.0;
  std::vector<haptics::HandRig> axes;
  glm::dvec3 most_n{0.0};
  int lost_at_ms = -1;

  // Until it is done; how long that took.
  int run(ArmCheck& check, int most_ms = 30'000) {
    int ms = 0;
    for (; ms < most_ms && check.step() != CheckStep::done; ++ms) {
      ArmReading reading;
      reading.position_mm = {axes[0].encoder_mm(), axes[1].encoder_mm(), axes[2].encoder_mm()};
      reading.round_trip_s = round_trip_s;
      reading.count = static_cast<std::uint64_t>(ms) + 1;
      reading.healthy = ms != lost_at_ms;
      const glm::dvec3 force_n = check.advance(reading, 0.001);
      most_n = glm::max(most_n, glm::abs(force_n));
      for (int axis = 0; axis < 3; ++axis) {
        // To and fro while it is to reach; then at rest in the middle.
        const double at =
            check.step() == CheckStep::reach ? 0.5 * reach_mm * std::sin(0.002 * ms * (1.0 + 0.1 * axis)) : 0.0;
        axes[static_cast<std::size_t>(axis)].hold(-sign[axis] * force_n[order[axis]], {at, 0.0, 0.0});
      }
      if (check.step() == CheckStep::reach && ms > 15'000) check.enough_reach();
    }
    return ms;
  }
};

TEST(ArmCheck, ASoundArmPassesWithoutMoreThanANewton) {
  Arm arm;
  ArmCheck check;
  arm.run(check);
  EXPECT_TRUE(check.holds());
  EXPECT_TRUE(check.reach_holds());
  for (const PushFound found : check.pushes()) EXPECT_EQ(found, PushFound::right);
  EXPECT_EQ(arm.most_n, glm::dvec3(kCheckForceN));
  EXPECT_GT(check.lateness().n, 1000U);
}

TEST(ArmCheck, AnAxisTheWrongWayRoundIsFound) {
  Arm arm;
  arm.sign[1] = -1.0;
  ArmCheck check;
  arm.run(check);
  EXPECT_FALSE(check.holds());
  const std::array<PushFound, 6> found = {PushFound::right,     PushFound::right, PushFound::wrong_way,
                                          PushFound::wrong_way, PushFound::right, PushFound::right};
  EXPECT_EQ(check.pushes(), found);
}

TEST(ArmCheck, ExchangedAxesAreFound) {
  Arm arm;
  arm.order[0] = 2;
  arm.order[2] = 0;
  ArmCheck check;
  arm.run(check);
  const std::array<PushFound, 6> found = {PushFound::wrong_way, PushFound::wrong_way, PushFound::right,
                                          PushFound::right,     PushFound::wrong_way, PushFound::wrong_way};
  EXPECT_EQ(check.pushes(), found);
}

TEST(ArmCheck, AMotorThatDoesNothingIsFound) {
  Arm arm;
  arm.sign[2] = 0.0;
  ArmCheck check;
  arm.run(check);
  EXPECT_EQ(check.pushes()[4], PushFound::still);
  EXPECT_EQ(check.pushes()[5], PushFound::still);
  EXPECT_FALSE(check.pushes_hold());
}

TEST(ArmCheck, AShortReachALateLinkAndALossAreTold) {
  Arm shallow;
  shallow.reach_mm = 60.0;
  ArmCheck check;
  shallow.run(check, 60'000);
  EXPECT_EQ(check.step(), CheckStep::done);
  EXPECT_FALSE(check.reach_holds());
  EXPECT_TRUE(check.pushes_hold());
  EXPECT_NEAR(check.reached_mm().x, 60.0, 2.0);

  Arm late;
  late.round_trip_s = 0.005;
  ArmCheck late_check;
  late.run(late_check);
  EXPECT_FALSE(late_check.lateness_holds());
  EXPECT_TRUE(late_check.pushes_hold());

  Arm lost;
  lost.lost_at_ms = 4000;
  ArmCheck lost_check;
  lost.run(lost_check);
  EXPECT_EQ(lost_check.lost(), 1U);
  EXPECT_FALSE(lost_check.holds());
  EXPECT_TRUE(lost_check.pushes_hold()) << "what was interrupted began again";
}

TEST(ArmCheck, AnArmThatNeverAnswersEndsIt) {
  ArmCheck check;
  int ms = 0;
  for (; ms < 60'000 && check.step() != CheckStep::done; ++ms) ASSERT_EQ(check.advance({}, 0.001), glm::dvec3(0.0));
  EXPECT_NEAR(ms, kCheckWaitS * 1000.0, 2.0);
  EXPECT_FALSE(check.answered());
  EXPECT_FALSE(check.holds());
}

TEST(ArmCheck, AnArmThatGoesSilentOrIsLostAgainAndAgainEndsIt) {
  for (const int well_ms : {100, 1'000'000}) {  // of each second; or once, and then never again
    ArmCheck check;
    ArmReading reading;
    int ms = 0;
    for (; ms < 60'000 && check.step() != CheckStep::done; ++ms) {
      reading.healthy = well_ms == 100 ? ms % 1000 < well_ms : ms < 3000;
      ++reading.count;
      check.advance(reading, 0.001);
    }
    EXPECT_EQ(check.step(), CheckStep::done);
    EXPECT_TRUE(check.answered());
    EXPECT_FALSE(check.holds());
    EXPECT_EQ(check.lost(), well_ms == 100 ? kMostLost : 1U);
    EXPECT_LT(ms, well_ms == 100 ? 20'000 : 14'000);
  }
}

}  // namespace
}  // namespace seldinger::devices
