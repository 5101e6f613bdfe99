// Hands with force at the workstation: shown, calibrated, exchanged and used.
#include <gtest/gtest.h>

#include <filesystem>

#include "tests/app/window/trainer/trainer_case.h"

namespace seldinger::app {
namespace {

TEST_F(TrainerTest, HandsAreShownFromAnyScreenButAnAttemptAndACalibrationIsTheNextAttempts) {
  publish();
  const auto led = LedArms::start();
  ASSERT_TRUE(led);
  Arms arms;
  arms.led = *led;
  arms.place = (*led)->place();
  arms.station_file = folder_ / "station.json";
  Trainer trainer(open(), arms);
  trainer.show_devices();
  EXPECT_EQ(trainer.screen(), TrainerScreen::devices) << "also before anybody logs in";
  trainer.leave_devices();
  EXPECT_EQ(trainer.screen(), TrainerScreen::log_in);
  trainer.log_in("mona", kPassword);
  trainer.choose(case_id_);
  ASSERT_TRUE(ready(trainer)) << trainer.refusal();
  trainer.show_devices();
  ASSERT_NE(trainer.device_page(), nullptr);
  ASSERT_TRUE(until([&] { return !trainer.device_page()->status().ids[1].arm.empty(); }));
  std::vector<devices::TakenPoint> taken;
  const devices::Placement device = devices::inverse_of(LedArms::template_from_device(1));
  for (const devices::TemplatePoint& point : devices::template_points())
    taken.push_back({point.name, device(point.template_mm)});
  ASSERT_TRUE(trainer.keep_calibration(1, *devices::calibrate(taken))) << trainer.refusal();
  const auto kept = read_station(arms.station_file);
  ASSERT_TRUE(kept);
  EXPECT_EQ(kept->at("right").calibration.points.size(), 6U);
  EXPECT_EQ(kept->at("right").ids.arm, "sim-right");
  EXPECT_EQ(kept->at("left").ids.arm, "sim-left") << "else the service would give it to nobody";
  trainer.exchange_arms();
  EXPECT_EQ(trainer.arms()->station.at("left").ids.arm, "sim-right");
  EXPECT_EQ(trainer.arms()->station.at("left").calibration.points.size(), 6U) << "it goes with its arm";
  ASSERT_TRUE(
      until([&] { return trainer.device_page()->seen().arms[0].reading.healthy; }));  // led by its id from here on
  EXPECT_EQ(trainer.device_page()->status().ids[0].arm, "sim-right");
  trainer.leave_devices();
  EXPECT_EQ(trainer.screen(), TrainerScreen::briefing) << "back where one was";
  EXPECT_EQ(trainer.device_page(), nullptr);

  // The mouse leads the arms, and these lead the tools.
  ASSERT_TRUE(trainer.begin(false));
  PersonAttempt& attempt = *trainer.attempt();
  Seen seen;
  ASSERT_TRUE(until([&] {
    if (const auto newest = attempt.seen()) seen = *newest;
    return seen.arms.used && !seen.arms.lost[0] && !seen.arms.lost[1] && !seen.by_mouse;
  }));
  HandsTold told;
  advance(attempt, told, kDepthMm);
  EXPECT_TRUE(until([&] {
    const auto newest = attempt.arms_seen();
    return newest && (*newest)[0].reading.healthy && (*newest)[0].force_n.bin(1).filled;
  })) << "what the arms do can be looked at";
  trainer.show_devices();
  EXPECT_EQ(trainer.screen(), TrainerScreen::attempt) << "not while they hold tools in a patient";
  attempt.end();
  ASSERT_TRUE(looks_until(trainer, TrainerScreen::debrief)) << trainer.refusal();
  trainer.show_devices();
  ASSERT_TRUE(until([&] {
    const ArmsSeen& now = trainer.device_page()->seen().arms;
    return now[0].reading.healthy && now[1].reading.healthy;
  })) << "the attempt has let the service go";
  // What cannot be kept is said, and nothing is changed.
  const Station before = trainer.arms()->station;
  std::filesystem::remove(arms.station_file);
  std::filesystem::create_directory(arms.station_file);
  EXPECT_FALSE(trainer.change_station([](Station& station) { station["left"].gains.force_share = 0.5; }));
  EXPECT_FALSE(trainer.refusal().empty());
  EXPECT_EQ(trainer.arms()->station.at("left").gains, before.at("left").gains);
}

}  // namespace
}  // namespace seldinger::app
