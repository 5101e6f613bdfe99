// A 3-D mouse (six axes, no force) through spacenavd. Where the daemon does not run there is none; nothing else
// needs it. libspnav keeps one connection a process, so there is one of these at a time, used by one thread.
#pragma once

#include <array>
#include <bitset>
#include <cstdint>

#include "sim/base/result.h"
#include "sim/devices/hands/mouse_hands.h"

namespace seldinger::devices {

// How the cap is deflected now, in the daemon's counts: along and about right, up, away from the user; about: right
// handed (spacenavd's axes with its rotations).
struct SpaceMouseReading {
  std::array<int, 3> along{}, about{};
  std::bitset<16> buttons;
};

class SpaceMouse {
 public:
  // Refused: `no_space_mouse`: nothing answers at SPNAV_SOCKET, nor where spacenavd listens by itself. May take
  // 0.3 s with an old daemon. One at a time (CHECKed).
  static base::Result<SpaceMouse> open();
  SpaceMouse(SpaceMouse&& other) noexcept;
  SpaceMouse& operator=(SpaceMouse&&) = delete;
  ~SpaceMouse();

  // What it says now; never waits. Once the daemon is gone: at rest, and connected() is false.
  const SpaceMouseReading& poll();
  bool connected() const noexcept { return connected_; }

 private:
  SpaceMouse() = default;
  bool open_ = true, connected_ = true;
  SpaceMouseReading reading_;
  std::bitset<16> down_;
};

// Full deflection is about 350 counts (spacenavd's documentation); speeds there, and what counts as rest (design).
inline constexpr double kCapCounts = 350.0, kCapSlideMmS = 80.0, kCapTurnRadS = 1.2;
inline constexpr int kCapRestCounts = 12;

// What a deflection wants in elapsed_s: the tool goes as the cap is pushed, in the camera's axes, in space.
// Buttons: 0 fires, 1 changes the tool, 2 freezes, 3 takes the guide; with two buttons only, keys do the rest.
class SpaceMouseHands {
 public:
  HandIntent intent(const SpaceMouseReading& reading, const HandView& view, double elapsed_s) noexcept;

 private:
  ActionEdges edges_;
};

}  // namespace seldinger::devices
