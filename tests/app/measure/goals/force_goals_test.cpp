// Tests of app/measure/goals/force_goals: the figures hold, and what is wrong is seen.
#include "app/measure/goals/force_goals.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace seldinger::measure {
namespace {

TEST(ForceGoals, AllHold) {
  std::vector<ForceReading> readings = force_readings();
  for (const ForceReading& one : proxy_readings(2000)) readings.push_back(one);
  EXPECT_EQ(readings.size(), 18U);
  for (const ForceReading& one : readings)
    EXPECT_TRUE(one.holds()) << one.what << " " << one.where << " " << one.measured << " " << one.unit;
}

TEST(ForceGoals, NoNumberHoldsNowhere) {
  EXPECT_FALSE((ForceReading{"", "", std::nan(""), "N", 1.0}.holds()));
  EXPECT_FALSE((ForceReading{"", "", std::nan(""), "N", 1.0, true}.holds()));
  EXPECT_TRUE((ForceReading{"", "", 1.0, "N", 1.0}.holds()));
  EXPECT_TRUE((ForceReading{"", "", 1.0, "N", 1.0, true}.holds()));
}

TEST(ForceGoals, OneTrialThatMovesIsCounted) {
  StabilitySurvey survey;
  for (const haptics::ArmModel& device : haptics::arm_models()) {
    RestRow row{device, *haptics::find_hand("medium"), "any", {}};
    row.settling.least_work_mj = 0.0;
    survey.rest.push_back(row);
    survey.margins.push_back({device, 1.4, nullptr});
  }
  for (const ForceReading& one : stability_readings(survey)) EXPECT_TRUE(one.holds()) << one.what << one.where;
  survey.rest[1].settling.force_n = 0.2;
  survey.margins[2].rests_at = 1.2;
  int missed = 0;
  for (const ForceReading& one : stability_readings(survey)) missed += !one.holds();
  EXPECT_EQ(missed, 2);
  for (const ForceReading& one : stability_readings({})) EXPECT_FALSE(one.holds()) << "of nothing nothing is known";
}

}  // namespace
}  // namespace seldinger::measure
