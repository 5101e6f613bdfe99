// A body to hold tools against, and a mouse that is moved evenly.
#pragma once

#include "sim/devices/hands/hands.h"
#include "sim/devices/hands/mouse_hands.h"
#include "tests/fixtures/meshes.h"

namespace seldinger::devices {

constexpr double kFrameS = 1.0 / 60.0;

// Skin at z = 0 facing up; caps on the sides, as at a volume's ends.
inline const cases::MeshIndex& flat_skin() {
  static const cases::MeshIndex skin(fixtures::box_mesh({-150.0, -150.0, -200.0}, {150.0, 150.0, 0.0}));
  return skin;
}

inline const cases::MeshIndex& round_skin() {
  static const cases::MeshIndex skin(fixtures::sphere_mesh({0.0, 0.0, 0.0}, 100.0, 5));
  return skin;
}

inline HandsStart above_flat() {
  return {{{0.0, 0.0, 15.0}, {0.0, 0.0, -1.0}, {1.0, 0.0, 0.0}},
          {{40.0, 0.0, 0.0}, {0.0, 0.0, -1.0}, {1.0, 0.0, 0.0}}};
}

// Looks along +y: right is +x, up +z.
inline HandView front_view() {
  return {{1.0, 0.0, 0.0}, {0.0, 0.0, 1.0}, {0.0, 1.0, 0.0}, 0.5};
}
// Looks down: right is +x, up on the screen +y.
inline HandView top_view() {
  return {{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, -1.0}, 0.5};
}

// What a window with hands does.
struct Desk {
  explicit Desk(const cases::MeshIndex& skin, const HandsStart& start, const HandsSettings& settings = {},
                bool left_handed = false)
      : hands(skin, start, settings), mouse(left_handed) {}

  void frame(MouseEvents events, double needle_n = 0.0) {
    events.elapsed_s = kFrameS;
    hands.advance(mouse.intent(events, view, hands.held(), hands.held_pose()), {needle_n, 0.0}, kFrameS);
  }
  void rest(int frames = 30) {
    for (int i = 0; i < frames; ++i) frame({});
  }
  // Slowly enough that nothing is lost; then what follows is waited for.
  void drag(double right_px, double down_px, bool MouseEvents::*button = &MouseEvents::primary,
            HeldActions actions = {}) {
    constexpr int kFrames = 60;
    for (int i = 0; i < kFrames; ++i) {
      MouseEvents events;
      events.right_px = right_px / kFrames;
      events.down_px = down_px / kFrames;
      events.*button = true;
      events.actions = actions;
      frame(events);
    }
    rest();
  }
  // A notch each fourth of a second: slow ones.
  void wheel(int notches, double needle_n = 0.0) {
    for (int i = 0; i < std::abs(notches); ++i)
      for (int f = 0; f < 15; ++f) {
        MouseEvents events;
        if (f == 0) events.wheel_notches = notches > 0 ? 1.0 : -1.0;
        frame(events, needle_n);
      }
  }
  void press(HandAction action) {
    MouseEvents events;
    events.actions.set(static_cast<std::size_t>(action));
    frame(events);
    frame({});
  }

  HandView view = front_view();
  Hands hands;
  MouseHands mouse;
};

}  // namespace seldinger::devices
