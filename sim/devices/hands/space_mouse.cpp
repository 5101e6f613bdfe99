#include "sim/devices/hands/space_mouse.h"

#include <spnav.h>
#include <sys/socket.h>

#include <cerrno>
#include <cmath>
#include <cstdlib>
#include <utility>

#include "sim/base/check.h"

namespace seldinger::devices {
namespace {

bool one_is_open = false;  // libspnav's connection is the process's

double beyond_rest(int counts) noexcept {
  const int size = std::abs(counts);
  return size <= kCapRestCounts ? 0.0 : std::copysign((size - kCapRestCounts) / kCapCounts, counts);
}

}  // namespace

base::Result<SpaceMouse> SpaceMouse::open() {
  CHECK(!one_is_open);
  if (::spnav_open() != 0)
    return base::Error{
        "no_space_mouse", "no 3-D mouse: spacenavd does not answer (is it installed and running?)", {}};
  one_is_open = true;
  return SpaceMouse();
}

SpaceMouse::SpaceMouse(SpaceMouse&& other) noexcept
    : open_(std::exchange(other.open_, false)),
      connected_(other.connected_),
      reading_(other.reading_),
      down_(other.down_) {}

SpaceMouse::~SpaceMouse() {
  if (!open_) return;
  ::spnav_close();
  one_is_open = false;
}

const SpaceMouseReading& SpaceMouse::poll() {
  decltype(reading_.buttons) pressed;  // a short press between two polls is down in the one after it
  // A burst is read at once; the bound is for a daemon that talks without end.
  for (int i = 0; i < 1000 && connected_; ++i) {
    // libspnav reads whole packets only, and cannot say that the daemon hung up.
    char packet[32];
    const ssize_t waiting = ::recv(::spnav_fd(), packet, sizeof packet, MSG_PEEK | MSG_DONTWAIT);
    if (waiting == 0 || (waiting < 0 && errno != EAGAIN && errno != EWOULDBLOCK && errno != EINTR)) {
      connected_ = false;
      reading_ = {};
      down_ = {};
    }
    if (waiting < static_cast<ssize_t>(sizeof packet)) break;
    spnav_event event;
    if (::spnav_poll_event(&event) == SPNAV_EVENT_MOTION) {
      const spnav_event_motion& m = event.motion;
      reading_.along = {m.x, m.y, m.z};
      reading_.about = {m.rx, m.ry, m.rz};
    } else if (event.type == SPNAV_EVENT_BUTTON && event.button.bnum >= 0 &&
               static_cast<std::size_t>(event.button.bnum) < reading_.buttons.size()) {
      const auto button = static_cast<std::size_t>(event.button.bnum);
      down_[button] = event.button.press != 0;
      if (down_[button]) pressed[button] = true;
    }
  }
  reading_.buttons = down_ | pressed;
  return reading_;
}

HandIntent SpaceMouseHands::intent(const SpaceMouseReading& reading, const HandView& view,
                                   double elapsed_s) noexcept {
  HandIntent intent;
  HeldActions actions;
  constexpr HandAction kButtons[] = {HandAction::fire, HandAction::swap, HandAction::freeze, HandAction::guide};
  for (std::size_t i = 0; i < std::size(kButtons); ++i)
    actions[static_cast<std::size_t>(kButtons[i])] = reading.buttons[i];
  edges_.say(actions, intent);
  const auto in_camera = [&](const std::array<int, 3>& counts) {
    return view.right * beyond_rest(counts[0]) + view.up * beyond_rest(counts[1]) +
           view.away * beyond_rest(counts[2]);
  };
  intent.slide_lps_mm = in_camera(reading.along) * (kCapSlideMmS * elapsed_s);
  intent.turn_lps_rad = in_camera(reading.about) * (kCapTurnRadS * elapsed_s);
  intent.in_space = true;
  return intent;
}

}  // namespace seldinger::devices
