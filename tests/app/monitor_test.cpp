// The guidance's screen without a window: what it draws, and when.
#include "app/train/monitor.h"

#include <gtest/gtest.h>

#include <chrono>
#include <thread>

#include "sim/volume/phantom.h"

namespace seldinger::app {
namespace {

constexpr double kLongS = 60.0;  // a test that fails ends, too

class MonitorTest : public testing::Test {
 protected:
  MonitorTest() {
    scene.volume = volume::make_phantom().volume;
    moment.state.probe.origin_lps_mm =
        glm::dvec3(scene.volume.lps_from_voxel * glm::dvec4(0.5 * glm::dvec3(scene.volume.size_voxels), 1.0));
    moment.state.probe.axial = {0.0, 1.0, 0.0};
    moment.state.probe.lateral = {1.0, 0.0, 0.0};
  }
  static ShownPicture next_of(Monitor& monitor) {
    ShownPicture shown;
    const double until_s = clock_s() + kLongS;
    while (!monitor.take(shown) && clock_s() < until_s) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    return shown;
  }
  cases::Case scene;
  engine::Moment moment;
};

TEST_F(MonitorTest, APictureThatIsAskedForIsOfTheNewestMoment) {
  Monitor monitor(scene, 0);
  double told_s = 0.0;
  for (int i = 1; i <= 5; ++i) {
    moment.told_s = told_s + 1.0;
    monitor.show(moment);
    moment.told_s = told_s += 2.0;  // shown later, and before it is asked
    monitor.show(moment);
    monitor.want();
    ShownPicture shown;
    do shown = next_of(monitor);  // one may have been on its way unasked
    while (shown.number > 0 && shown.told_s < told_s);
    EXPECT_EQ(shown.told_s, told_s);
    EXPECT_GT(shown.picture.width_px, 0);
    EXPECT_TRUE(shown.live);
  }
}

TEST_F(MonitorTest, WhatIsAskedForIsExpectedUntilItIsThere) {
  Monitor monitor(scene, 0);
  monitor.show(moment);
  EXPECT_GT(next_of(monitor).number, 0U) << "the first comes unasked";
  moment.told_s = 7.0;
  monitor.show(moment);
  monitor.want();
  EXPECT_TRUE(monitor.expected_s().has_value() || monitor.fresh());
  EXPECT_EQ(next_of(monitor).told_s, 7.0);
  const double until_s = clock_s() + kLongS;
  while (monitor.expected_s() && clock_s() < until_s) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  EXPECT_LT(clock_s(), until_s) << "nothing is asked for any more, and nothing new is there to be drawn";
}

}  // namespace
}  // namespace seldinger::app
