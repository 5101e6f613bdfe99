// The room as the trainee sees it: patient, probe and needle, with the camera, and the hands' mouse and keys.
#pragma once

#include <memory>
#include <optional>

#include "app/train/person_attempt.h"
#include "app/train/window.h"
#include "sim/devices/gamepad_hands.h"
#include "sim/devices/mouse_hands.h"
#include "sim/devices/space_mouse.h"
#include "sim/imaging/room/room_renderer.h"

namespace seldinger::app {

// What else there is for hands beside mouse and keys, as it is now.
struct OtherHands {
  std::optional<devices::GamepadReading> gamepad;
  std::optional<devices::SpaceMouseReading> space_mouse;
};

class RoomPanel {
 public:
  explicit RoomPanel(gpu::Context& context) : context_(context) {}

  // A new attempt.
  void begin(const cases::Case& scene, bool left_handed);
  void end() noexcept { room_.reset(); }

  // In what room there is; what mouse, keys and `other` want is added to `sum`.
  void draw(const cases::Case& scene, const Seen& seen, int help, const Keys& keys, const OtherHands& other,
            double elapsed_s, devices::HandIntent& sum);

  bool stereo() const noexcept { return stereo_; }
  void set_stereo(bool stereo) noexcept { stereo_ = stereo; }
  void set_view(imaging::RoomView view) noexcept { view_ = view; }

 private:
  struct Room {
    Room(gpu::Context& context, const cases::Case& drawn, bool left_handed)
        : scene(imaging::make_room_scene(drawn)),
          renderer(context, scene),
          mouse(left_handed),
          gamepad(left_handed) {}
    imaging::RoomScene scene;
    imaging::RoomRenderer renderer;
    imaging::RoomCamera camera;
    imaging::RoomCamera from, to;  // of a view that is on its way
    double on_way = 1.0;           // 0 … 1
    imaging::DrawList list;
    devices::MouseHands mouse;
    devices::GamepadHands gamepad;
    devices::SpaceMouseHands space_mouse;
  };
  void move_camera(Room& room, const cases::Case& scene, const cases::State& state, const Keys& keys,
                   double elapsed_s);
  devices::HandView hand_view(const Room& room, const cases::ToolPose& tool, float height_px) const;

  gpu::Context& context_;
  std::unique_ptr<Room> room_;
  std::optional<imaging::RoomView> view_;  // asked for
  bool stereo_ = false, begun_ = false;
};

}  // namespace seldinger::app
