// The guidance's screen without a window: what it draws, and when.
#include "session/monitor/monitor.h"

#include <gtest/gtest.h>

#include "sim/volume/phantom.h"
#include "tests/fixtures/until.h"

namespace seldinger::session {
namespace {

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
    fixtures::until([&] { return monitor.take(shown); });
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
  int told = 0;
  for (int i = 1; i <= 20; ++i) {
    moment.told_s = i;
    monitor.show(moment);
    monitor.want();
    // Asked in this order: what is no longer expected is there, since it becomes both under one lock.
    const auto expected_s = monitor.expected_s();
    const bool there = monitor.fresh();
    EXPECT_TRUE(expected_s || there) << "a picture that was asked for is on its way or there";
    if (expected_s) {
      ++told;
      EXPECT_NEAR(*expected_s, clock_s(), fixtures::kPatienceS);
    }
    ShownPicture shown;
    do shown = next_of(monitor);  // one may have been on its way unasked
    while (shown.number > 0 && shown.told_s < moment.told_s);
    EXPECT_EQ(shown.told_s, moment.told_s);
    EXPECT_TRUE(fixtures::until([&] { return !monitor.expected_s(); })) << "nothing is asked for any more";
  }
  EXPECT_GT(told, 0) << "a picture takes longer than asking when it comes";
}

}  // namespace
}  // namespace seldinger::session
