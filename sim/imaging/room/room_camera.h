// Where the room is looked at from, in double: where an eye stands, what it looks at, how places come to lie in the
// picture.
#pragma once

#include <array>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <string_view>

#include "sim/case/case.h"
#include "sim/case/state.h"
#include "sim/imaging/room/room_model.h"

namespace seldinger::imaging {

// along_plane: the plane of the probe's picture edge-on, from the needle's side; a needle beside it is seen to be.
enum class RoomView { operator_side, head_end, foot_end, top, over_needle, along_needle, near_probe, along_plane };
constexpr std::array<std::string_view, 8> kRoomViewNames = {
    "operator_side", "head_end", "foot_end", "top", "over_needle", "along_needle", "near_probe", "along_plane"};
std::optional<RoomView> room_view_named(std::string_view name) noexcept;

struct RoomCamera {
  glm::dvec3 eye_lps_mm{0.0, -600.0, 0.0};
  glm::dvec3 target_lps_mm{0.0};
  glm::dvec3 up{0.0, 0.0, 1.0};     // unit; not along the line of sight
  double height_deg = 35.0;         // of the picture, seen from the eye
  double eye_separation_mm = 63.0;  // of a pair: people's mean
};

// A preset. `state` tells where needle and probe are; needle hub and way in are in view (stay_clear), and the probe
// is not before them where another look from near by helps.
RoomCamera room_camera(const RoomModel& room, const cases::Case& scene, const cases::State& state, RoomView view);

// So that it does not stand in the way of its own sight: back from the target until the eye is outside the skin by
// some centimetres and every place of `in_view` is in the picture (as far as the walls allow); up, above the floor.
void stay_clear(RoomCamera& camera, const RoomFrame& frame, const cases::MeshIndex& skin,
                std::span<const glm::dvec3> in_view, double width_per_height);

// So that no tool is cut by the picture's near plane: back from the target until the eye is clear of probe and hub.
void stay_off_tools(RoomCamera& camera, const RoomModel& room, const cases::State& state);

// On the way between two: 0 the one, 1 the other, slow at both ends; the eye turns about what is looked at.
RoomCamera between(const RoomCamera& from, const RoomCamera& to, double share);

// About the target: to the right and up, in degrees; never over the top.
void orbit(RoomCamera& camera, const RoomFrame& frame, double right_deg, double up_deg);
// Target and eye along the picture, in shares of its height at the target.
void pan(RoomCamera& camera, double right, double up);
// Distance to the target times `factor` (> 0).
void zoom(RoomCamera& camera, double factor);

// One eye of a pair: −1 left, 0 the middle, 1 right. Both look straight ahead through frusta that lie askew, so
// that what is as far as the target has no parallax.
struct RoomProjection {
  glm::dvec3 eye_lps_mm{0.0};
  glm::dmat4 eye_from_lps{1.0};   // x right, y up, z towards the viewer, mm
  glm::dmat4 clip_from_eye{1.0};  // GL's: near −1, far 1
};
RoomProjection projection_of(const RoomCamera& camera, int eye, double width_per_height);

// Pixels from the picture's upper left corner; nothing behind the eye.
std::optional<glm::dvec2> pixel_of(const RoomProjection& projection, const glm::dvec3& place_lps_mm, int width_px,
                                   int height_px) noexcept;
// The unit direction in which such a pixel is seen from the eye.
glm::dvec3 ray_of(const RoomProjection& projection, const glm::dvec2& pixel, int width_px, int height_px) noexcept;

}  // namespace seldinger::imaging
