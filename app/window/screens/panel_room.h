// The room as the trainee sees it: patient, probe and needle, with the camera, and the hands' mouse and keys.
#pragma once

#include <array>
#include <future>
#include <memory>
#include <optional>

#include "app/window/hands/person_attempt.h"
#include "app/window/surface/window.h"
#include "sim/case/hand_kind.h"
#include "sim/devices/hands/gamepad_hands.h"
#include "sim/devices/hands/mouse_hands.h"
#include "sim/devices/hands/space_mouse.h"
#include "sim/gpu/fence.h"
#include "sim/imaging/room/room_renderer.h"

namespace seldinger::app {

// What else there is for hands beside mouse and keys, as it is now.
struct OtherHands {
  std::optional<devices::GamepadReading> gamepad;
  std::optional<devices::SpaceMouseReading> space_mouse;
};

// What of the patient is in the way; all but the whole for a mentor who looks back.
enum class RoomInside { whole, cut_away, looked_through };

class RoomPanel {
 public:
  explicit RoomPanel(gpu::Context& context) : context_(context) {}

  // A new attempt.
  void begin(const cases::Case& scene, bool left_handed);
  void end() noexcept {
    drawn_.reset();
    making_ = {};
    room_.reset();
  }

  // It takes what room there is, and the camera goes on.
  void place(const cases::Case& scene, const Seen& seen, const Keys& keys, double elapsed_s);
  // What mouse, keys and `other` want since the last call is added to `sum`: in a frame once the room is placed,
  // and between frames. `wheel`: notches. What of them moves the tool, the most of it where it is several; nothing:
  // none does.
  std::optional<cases::HandKind> hands(const Seen& seen, const Keys& keys, const Pointer& pointer, double wheel,
                                       const OtherHands& other, double elapsed_s, devices::HandIntent& sum);
  // What the hand's ways are for the tool that is held, in the room as it is seen.
  devices::HandView view_of_hands(const Seen& seen) const;
  bool under_pointer() const noexcept { return over_ || dragging_; }  // when it was placed
  // Where it was placed, of the newest that is seen.
  void draw(const cases::Case& scene, const Seen& seen, int help);
  // Whether what was drawn is finished; waits for that no longer than told.
  bool finished(double most_s);

  bool stereo() const noexcept { return stereo_; }
  void set_stereo(bool stereo) noexcept { stereo_ = stereo; }
  void set_view(imaging::RoomView view);
  // Over the picture's upper right corner: which view it is, and a list of them.
  void draw_views();
  RoomInside inside() const noexcept { return inside_; }
  // The next of them; what is inside takes a moment to be made.
  void look_inside(std::shared_ptr<const cases::Case> scene);

 private:
  struct Room {
    Room(gpu::Context& context, imaging::RoomModel made, bool left_handed)
        : scene(std::move(made)), renderer(context, scene), mouse(left_handed), gamepad(left_handed) {}
    imaging::RoomModel scene;
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

  void take_made();

  gpu::Context& context_;
  std::unique_ptr<Room> room_;
  std::future<imaging::RoomModel> making_;  // the room with what is inside
  RoomInside inside_ = RoomInside::whole;
  bool left_handed_ = false, has_inside_ = false;
  std::optional<imaging::RoomView> view_;                       // asked for
  imaging::RoomView named_ = imaging::RoomView::operator_side;  // asked for last,
  bool own_ = false;                                            // and turned or shifted since
  double zoom_ = 1.0;  // of its distance, by its user; kept from view to view
  bool stereo_ = false, begun_ = false;
  std::array<float, 2> corner_px_{}, size_px_{};  // where it is placed
  bool over_ = false, dragging_ = false;
  Pointer pointer_;  // when hands were read last
  std::optional<gpu::Fence> drawn_;
};

}  // namespace seldinger::app
