// Tests of app/window/hands/device_page and device_words: two simulated arms are looked at, checked and calibrated
// as somebody at their styli does it. Time is real; what is waited for has no bound but patience.
#include "app/window/hands/device_page.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <glm/geometric.hpp>

#include "app/hands/device_words.h"
#include "tests/fixtures/until.h"

namespace seldinger::app {
namespace {

using Work = DevicePage::Work;

bool until(const std::function<bool()>& holds, double most_s = 120.0) {
  return fixtures::until(holds, most_s);  // twice as patient: under sanitizers an arm is lost now and then
}

struct AtTheDesk {
  AtTheDesk() : led(*LedArms::start()) {
    arms.place = led->place();
    arms.led = led;
    page = std::make_unique<DevicePage>(arms);
  }
  bool well() {
    return until([&] {
      const ArmsSeen& seen = page->seen().arms;
      return seen[0].reading.healthy && seen[1].reading.healthy;
    });
  }
  // The stylus goes there, as fast as a hand would.
  void go(std::size_t side, const glm::dvec3& to_mm) {
    while (glm::length(to_mm - styli[side].at_mm) > 0.0) {
      const glm::dvec3 way = to_mm - styli[side].at_mm;
      styli[side].at_mm += way * std::min(1.0, 2.0 / glm::length(way));
      led->lead(side, styli[side]);
      fixtures::let_pass(0.004);  // a hand's speed: half a millimetre in a millisecond
    }
    until([&] { return glm::length(page->seen().arms[side].reading.position_mm - to_mm) < 0.5; });
  }
  void press(std::size_t side) {
    for (const bool down : {true, false}) {
      styli[side].button = down;
      led->lead(side, styli[side]);
      until([&] { return page->seen().arms[side].reading.buttons.test(0) == down; }, 1.0);  // or it is lost
    }
  }
  // Touches the point that is asked for, off by so much.
  void touch(std::size_t side, const glm::dvec3& off_mm = glm::dvec3(0.0)) {
    const auto asked = page->seen().taking.asked();
    ASSERT_TRUE(asked);
    const glm::dvec3 at = devices::template_points()[*asked].template_mm + off_mm;
    go(side, devices::inverse_of(LedArms::template_from_device(side))(at));
    ASSERT_TRUE(until([&] {
      press(side);
      return until([&] { return page->seen().taking.taken_mm()[*asked].has_value(); }, 1.0);
    })) << taking_asks(page->seen().taking);
  }
  std::shared_ptr<LedArms> led;
  Arms arms;
  std::array<LedStylus, 2> styli;
  std::unique_ptr<DevicePage> page;
};

TEST(DevicePage, ShowsWhereBothArmsAreAndHowOftenTheySpeak) {
  AtTheDesk desk;
  ASSERT_TRUE(desk.well());
  desk.go(0, {-40.0, 120.0, 10.0});
  desk.go(1, {30.0, 90.0, -20.0});
  ASSERT_TRUE(until([&] {
    const ArmsSeen& seen = desk.page->seen().arms;
    return glm::length(seen[0].reading.position_mm - glm::dvec3(-40.0, 120.0, 10.0)) < 1.0 &&
           glm::length(seen[1].reading.position_mm - glm::dvec3(30.0, 90.0, -20.0)) < 1.0 &&
           seen[0].readings_per_s > 100.0 && seen[1].readings_per_s > 100.0;
  }));
  const ArmsSeen seen = desk.page->seen().arms;
  float least = 1e9F, most = -1e9F;
  for (std::size_t i = 0; i < devices::kTraceBins; ++i)
    if (const auto& bin = seen[0].at_mm[1].bin(i); bin.filled) {
      least = std::min(least, bin.least);
      most = std::max(most, bin.most);
    }
  EXPECT_LT(least, 101.0F) << "the trace has its way, from 100 mm";
  EXPECT_GT(most, 119.0F);
  const auto status = desk.page->status();
  EXPECT_NE(arm_words(seen[0], status.ids[0], status).find("arm sim-left, grip sim-grip-left: well"),
            std::string::npos)
      << arm_words(seen[0], status.ids[0], status);

  desk.led->service().set({.unplugged = {false, true}});
  ASSERT_TRUE(until([&] {
    const ArmsSeen& now = desk.page->seen().arms;
    return now[0].reading.healthy && !now[1].reading.healthy;
  })) << "one arm is lost, the other is not";
  const auto without = desk.page->status();
  EXPECT_NE(arm_words(desk.page->seen().arms[1], without.ids[1], without).find("does not report this arm"),
            std::string::npos);
  desk.led->service().set({.away = true});
  ASSERT_TRUE(until([&] { return !desk.page->status().connected; }));
  EXPECT_EQ(arm_words({}, without.ids[0], desk.page->status()), "no service answers");
}

// From its beginning to its end; the largest force that was asked for, in newtons.
double checked(AtTheDesk& desk) {
  const auto now = [&] { return desk.page->seen().check; };
  desk.page->check(1);
  EXPECT_TRUE(until([&] { return now().step() == devices::CheckStep::reach; }));
  EXPECT_NE(check_asks(now()).find("as far as it goes"), std::string::npos);
  for (const glm::dvec3& corner : {glm::dvec3(-60, 40, -60), glm::dvec3(60, 160, 60)}) desk.go(1, corner);
  EXPECT_TRUE(
      until([&] { return now().step() == devices::CheckStep::push || now().step() == devices::CheckStep::done; }));
  double most_n = 0.0;
  EXPECT_TRUE(until([&] {
    most_n = std::max(most_n, glm::length(desk.led->service().arm(1).asked_n));
    EXPECT_EQ(desk.led->service().arm(0).asked_n, glm::dvec3(0.0)) << "the other arm is left alone";
    return now().step() == devices::CheckStep::done;
  })) << check_asks(now());
  return most_n;
}

TEST(DevicePage, ASelfTestAsksForReachPushesAndSaysWhatItFound) {
  AtTheDesk desk;
  ASSERT_TRUE(desk.well());
  // A program too slow for an arm's milliseconds is told so: under sanitizers for good, else while the machine
  // stalls, which may take minutes.
#ifdef __SANITIZE_ADDRESS__
  constexpr int kTries = 2;
#else
  constexpr int kTries = 30;
#endif
  double most_n = 0.0;
  devices::ArmCheck check;
  for (int tried = 0; tried < kTries && (tried == 0 || check.lost() == devices::kMostLost); ++tried) {
    if (tried > 0) fixtures::let_pass(3.0);
    most_n = checked(desk);
    check = desk.page->seen().check;
  }
  if (check.lost() == devices::kMostLost) {
    EXPECT_EQ(check_asks(check), "This arm is not fit for an attempt.");
#ifndef __SANITIZE_ADDRESS__
    ADD_FAILURE() << "lost too often, each time";
#endif
    return;
  }
  EXPECT_NEAR(most_n, devices::kCheckForceN, 1e-9);
  EXPECT_TRUE(check.pushes_hold());
  const auto lines = check_lines(check);
  ASSERT_EQ(lines.size(), 5U);
  // How late it is, and whether it was lost, is this machine's matter today.
  for (const std::size_t line : {0U, 1U, 2U})
    EXPECT_EQ(lines[line].state, CheckLine::State::holds) << lines[line].words;
  EXPECT_EQ(check_asks(check),
            check.holds() ? "This arm is fit for an attempt." : "This arm is not fit for an attempt.");
}

TEST(DevicePage, SixPointsCalibrateAnArmAndAWrongOneIsNamedAndTakenAgain) {
  AtTheDesk desk;
  ASSERT_TRUE(desk.well());
  desk.page->calibrate(0);
  ASSERT_TRUE(until([&] { return desk.page->seen().work == Work::calibrate; }));
  EXPECT_NE(taking_asks(desk.page->seen().taking).find("a: the cross, its left end"), std::string::npos);
  for (int point = 0; point < 6; ++point)
    ASSERT_NO_FATAL_FAILURE(desk.touch(0, point == 1 ? glm::dvec3(0.0, 0.0, 8.0) : glm::dvec3(0.0)));
  auto calibration = devices::calibrate(desk.page->seen().taking.points());
  ASSERT_FALSE(calibration);
  const std::string refused = calibration_words(calibration);
  EXPECT_EQ(refused.rfind("Refused: ", 0), 0U) << refused;
  EXPECT_NE(refused.find("without point b the others agree"), std::string::npos) << refused;
  desk.page->take_again(1);
  ASSERT_TRUE(until([&] { return desk.page->seen().taking.asked() == 1U; }));
  ASSERT_NO_FATAL_FAILURE(desk.touch(0));
  calibration = devices::calibrate(desk.page->seen().taking.points());
  ASSERT_TRUE(calibration) << calibration_words(calibration);
  EXPECT_EQ(calibration_words(calibration).rfind("Good: off by at most 0.", 0), 0U)
      << calibration_words(calibration);
  const devices::Placement stands = LedArms::template_from_device(0);
  EXPECT_LT(glm::length(calibration->template_from_device.translation_mm - stands.translation_mm), 2.0);
  EXPECT_NEAR(calibration->template_from_device.rotation[0].x, stands.rotation[0].x, 0.01);
}

TEST(DeviceWords, ACheckThatFailedSaysWhere) {
  devices::ArmCheck check;
  devices::ArmReading silent;
  for (int i = 0; i < 11000; ++i) check.advance(silent, 0.001);
  ASSERT_EQ(check.step(), devices::CheckStep::done);
  EXPECT_EQ(check_asks(check), "This arm is not fit for an attempt.");
  EXPECT_EQ(check_lines(check)[0].words, "No answer");
  EXPECT_EQ(check_lines(check)[0].state, CheckLine::State::fails);
  EXPECT_EQ(check_lines(check)[2].words, "Not tried along +x −x +y −y +z −z");
  EXPECT_EQ(check_lines(check)[2].state, CheckLine::State::fails);

  // Held fast: it reaches, and gives way to no push.
  check = {};
  devices::ArmReading held;
  held.healthy = true;
  for (int i = 0; i < 2; ++i) {
    held.position_mm = i == 0 ? glm::dvec3(0.0) : glm::dvec3(110.0);
    ++held.count;
    check.advance(held, 0.001);
  }
  for (int i = 0; i < 10000 && check.step() != devices::CheckStep::done; ++i) {
    ++held.count;
    check.advance(held, 0.001);
  }
  ASSERT_EQ(check.step(), devices::CheckStep::done);
  const CheckLine pushes = check_lines(check)[2];
  EXPECT_EQ(pushes.state, CheckLine::State::fails);
  EXPECT_EQ(pushes.words, "Does not push along +x −x +y −y +z −z: held too fast, or a motor is off");
}

}  // namespace
}  // namespace seldinger::app
