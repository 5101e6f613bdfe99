// Tests of sim/devices/hands/space_mouse, against a daemon of our own on a socket of the test's.
#include "sim/devices/hands/space_mouse.h"

#include <gtest/gtest.h>
#include <spnav.h>

#include <cstdlib>
#include <glm/geometric.hpp>

#include "tests/fixtures/spacenav_daemon.h"
#include "tests/sim/devices/hands_fixture.h"

namespace seldinger::devices {
namespace {

using Daemon = fixtures::SpacenavDaemon;

TEST(SpaceMouse, WithoutADaemonThereIsNone) {
  ::setenv("SPNAV_SOCKET", "/nonexistent/socket", 1);
  const auto mouse = SpaceMouse::open();
  ASSERT_FALSE(mouse) << "or this machine has one";
  EXPECT_EQ(mouse.error().code, "no_space_mouse");
  EXPECT_NE(mouse.error().text.find("spacenavd"), std::string::npos);
}

TEST(SpaceMouse, SaysHowTheCapIsHeldAndWhichButtonsAreDown) {
  Daemon daemon;
  auto mouse = SpaceMouse::open();
  ASSERT_TRUE(mouse);
  daemon.ready();
  EXPECT_EQ(mouse->poll().along, (std::array<int, 3>{}));
  daemon.motion({100, -20, 300}, {1, 2, 3});
  daemon.motion({101, -21, 301}, {4, 5, 6});  // the newest counts
  daemon.button(1, true);
  daemon.button(99, true);  // more than we know
  const SpaceMouseReading& reading = mouse->poll();
  EXPECT_EQ(reading.along, (std::array<int, 3>{101, -21, 301}));
  EXPECT_EQ(reading.about, (std::array<int, 3>{4, 5, 6}));
  EXPECT_EQ(reading.buttons.to_ulong(), 2UL);
  daemon.button(1, false);
  EXPECT_EQ(mouse->poll().buttons.to_ulong(), 0UL);
  daemon.button(2, true);
  daemon.button(2, false);
  EXPECT_EQ(mouse->poll().buttons.to_ulong(), 4UL) << "a short press between two looks is one";
  EXPECT_EQ(mouse->poll().buttons.to_ulong(), 0UL);
}

TEST(SpaceMouse, HalfAPacketWaitsForItsOtherHalf) {
  Daemon daemon;
  auto mouse = SpaceMouse::open();
  ASSERT_TRUE(mouse);
  daemon.ready();
  const std::array<std::int32_t, 8> packet{0, 7, 8, 9, 1, 2, 3, 16};
  daemon.say(packet, 13);
  EXPECT_EQ(mouse->poll().along[0], 0);
  daemon.rest_of(packet, 13);
  EXPECT_EQ(mouse->poll().along, (std::array<int, 3>{7, 8, 9}));
}

TEST(SpaceMouse, ALostDaemonLeavesTheCapAtRest) {
  Daemon daemon;
  auto mouse = SpaceMouse::open();
  ASSERT_TRUE(mouse);
  daemon.ready();
  daemon.motion({300, 0, 0}, {});
  EXPECT_EQ(mouse->poll().along[0], 300);
  EXPECT_TRUE(mouse->connected());
  daemon.hang_up();
  EXPECT_EQ(mouse->poll().along[0], 0) << "nothing drifts on";
  EXPECT_FALSE(mouse->connected());
}

TEST(SpaceMouse, IsTakenUpAgainByAnother) {
  for (const bool answers : {true, false}) {  // the second is a daemon from before protocols were numbered
    Daemon daemon(answers);
    auto mouse = SpaceMouse::open();
    ASSERT_TRUE(mouse);
    daemon.ready();
    daemon.motion({50, 60, 70}, {});
    EXPECT_EQ(mouse->poll().along, (std::array<int, 3>{50, 60, 70}));
  }
}

// libspnav's own way to move an object by an event, in OpenGL's axes, is the oracle of ours.
TEST(SpaceMouseHands, MovesAToolAsTheDaemonsLibraryMovesAnObject) {
  const HandView view = front_view();
  for (int axis = 0; axis < 6; ++axis) {
    SpaceMouseReading reading;
    spnav_event_motion event{};
    (axis < 3 ? reading.along : reading.about)[static_cast<std::size_t>(axis % 3)] = 200;
    int* const fields[] = {&event.x, &event.y, &event.z, &event.rx, &event.ry, &event.rz};
    *fields[axis] = 200;
    spnav_posrot object;
    ::spnav_posrot_init(&object);
    ::spnav_posrot_moveobj(&object, &event);
    const auto in_camera = [&](const float* v) {
      return view.right * static_cast<double>(v[0]) + view.up * static_cast<double>(v[1]) -
             view.away * static_cast<double>(v[2]);
    };
    SpaceMouseHands hands;
    const HandIntent intent = hands.intent(reading, view, 0.1);
    const glm::dvec3 ours = axis < 3 ? intent.slide_lps_mm : intent.turn_lps_rad;
    const glm::dvec3 theirs = in_camera(axis < 3 ? object.pos : object.rot);
    ASSERT_GT(glm::length(ours), 0.0);
    EXPECT_LT(glm::length(glm::normalize(ours) - glm::normalize(theirs)), 1e-6) << axis;
  }
}

TEST(SpaceMouseHands, PushesANeedleInAlongItsAxisOnly) {
  Hands hands(flat_skin(), above_flat());
  SpaceMouseHands mouse;
  SpaceMouseReading push;
  push.along = {0, -350, 0};  // down on the screen of the front view
  for (int i = 0; i < 600; ++i) hands.advance(mouse.intent(push, front_view(), 0.001), {}, 0.001);
  EXPECT_FALSE(hands.needle_inserted()) << "set down; a slide does not puncture";
  HandIntent step;
  step.advance_mm = 1.0;
  for (int i = 0; i < 300; ++i) {
    hands.advance(step, {}, 0.001);
    step.advance_mm = 0.0;
  }
  ASSERT_TRUE(hands.needle_inserted());
  for (int i = 0; i < 500; ++i) hands.advance(mouse.intent(push, front_view(), 0.001), {}, 0.001);
  EXPECT_NEAR(hands.inserted_mm(), 1.0 + 0.5 * kInsertMmS, 0.1) << "the cap wants 77 mm/s, tissue lets 60";
  EXPECT_NEAR(hands.needle().position_lps_mm.x, 0.0, 1e-9);
}

}  // namespace
}  // namespace seldinger::devices
