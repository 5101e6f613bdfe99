#include "sim/imaging/room/room_camera.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <numbers>

#include "sim/base/check.h"

namespace seldinger::imaging {
namespace {

constexpr double kDeg = std::numbers::pi / 180.0;

double far_of(double distance_mm) {
  return distance_mm + 8000.0;  // the room's far corner
}

glm::dmat3 axes_of(const RoomCamera& camera) {
  const glm::dvec3 back = glm::normalize(camera.eye_lps_mm - camera.target_lps_mm);
  const glm::dvec3 right = glm::normalize(glm::cross(camera.up, back));
  return {right, glm::cross(back, right), back};
}

}  // namespace

std::optional<RoomView> room_view_named(std::string_view name) noexcept {
  for (std::size_t i = 0; i < kRoomViewNames.size(); ++i)
    if (kRoomViewNames[i] == name) return static_cast<RoomView>(i);
  return std::nullopt;
}

RoomCamera room_camera(const RoomScene& room, const cases::Case& scene, const cases::State& state, RoomView view) {
  const RoomFrame& f = room.frame;
  RoomCamera camera;
  camera.up = f.up;
  const glm::dvec3 needle = state.needle.direction, tip = state.needle.tip_lps_mm;
  glm::dvec3 site = scene.planned_entry_lps_mm ? *scene.planned_entry_lps_mm : tip;
  if (state.needle.skin.in_body) site = state.needle.skin.entry_lps_mm;
  // The operator stands on the side where the way in is; right of the patient when it is in the middle.
  const double side = glm::dot(site - f.middle_lps_mm(), f.across) > 20.0 ? 1.0 : -1.0;
  camera.target_lps_mm = site;
  const auto from = [&](double across, double head, double up, double distance_mm) {
    camera.eye_lps_mm =
        camera.target_lps_mm + distance_mm * glm::normalize(f.across * across + f.head * head + f.up * up);
  };
  switch (view) {
    case RoomView::operator_side:
      from(side, -0.25, 0.75, 850.0);
      break;
    case RoomView::head_end:
      from(0.15 * side, 1.0, 0.7, 900.0);
      break;
    case RoomView::foot_end:
      from(0.15 * side, -1.0, 0.7, 900.0);
      break;
    case RoomView::top:
      camera.up = f.head;
      from(0.0, 0.0, 1.0, 900.0);
      break;
    case RoomView::over_needle:
      from(0.45 * side, -0.2, 0.9, 420.0);
      break;
    case RoomView::along_needle:
      camera.eye_lps_mm = tip - needle * (scene.instrument.length_mm + 260.0) + f.up * 40.0;
      break;
    case RoomView::near_probe:
      camera.target_lps_mm = state.probe.origin_lps_mm;
      from(side, -0.7, 0.6, 380.0);
      break;
  }
  const glm::dvec3 back = camera.eye_lps_mm - camera.target_lps_mm;
  if (glm::length(glm::cross(camera.up, back)) < 0.05 * glm::length(back)) camera.up = f.head;
  return camera;
}

void orbit(RoomCamera& camera, const RoomFrame& frame, double right_deg, double up_deg) {
  const double distance_mm = glm::distance(camera.eye_lps_mm, camera.target_lps_mm);
  const glm::dvec3 back = (camera.eye_lps_mm - camera.target_lps_mm) / distance_mm;
  const double rise = std::asin(std::clamp(glm::dot(back, frame.up), -1.0, 1.0));
  const double round = std::atan2(glm::dot(back, frame.head), glm::dot(back, frame.across)) + kDeg * right_deg;
  const double risen = std::clamp(rise + kDeg * up_deg, -80.0 * kDeg, 85.0 * kDeg);
  camera.eye_lps_mm =
      camera.target_lps_mm + distance_mm * frame.lps(std::cos(risen) * std::cos(round),
                                                     std::cos(risen) * std::sin(round), std::sin(risen));
  camera.up = frame.up;
}

void pan(RoomCamera& camera, double right, double up) {
  const glm::dmat3 axes = axes_of(camera);
  const double height_mm =
      2.0 * std::tan(0.5 * kDeg * camera.height_deg) * glm::distance(camera.eye_lps_mm, camera.target_lps_mm);
  const glm::dvec3 way = height_mm * (axes[0] * right + axes[1] * up);
  camera.eye_lps_mm += way;
  camera.target_lps_mm += way;
}

void zoom(RoomCamera& camera, double factor) {
  CHECK(factor > 0.0);
  camera.eye_lps_mm = camera.target_lps_mm + factor * (camera.eye_lps_mm - camera.target_lps_mm);
}

RoomProjection projection_of(const RoomCamera& camera, int eye, double width_per_height) {
  const glm::dmat3 axes = axes_of(camera);
  const double distance_mm = glm::distance(camera.eye_lps_mm, camera.target_lps_mm);
  const double aside_mm = 0.5 * eye * camera.eye_separation_mm;
  RoomProjection p;
  p.eye_lps_mm = camera.eye_lps_mm + axes[0] * aside_mm;
  p.eye_from_lps = glm::dmat4(glm::transpose(axes));
  p.eye_from_lps[3] = glm::dvec4(-(glm::transpose(axes) * p.eye_lps_mm), 1.0);
  const double near_mm = std::max(5.0, 0.05 * distance_mm);
  const double half_height = near_mm * std::tan(0.5 * kDeg * camera.height_deg);
  const double half_width = half_height * width_per_height;
  const double askew = aside_mm * near_mm / distance_mm;
  p.clip_from_eye = glm::frustum(-half_width - askew, half_width - askew, -half_height, half_height, near_mm,
                                 far_of(distance_mm));
  return p;
}

std::optional<glm::dvec2> pixel_of(const RoomProjection& projection, const glm::dvec3& place_lps_mm, int width_px,
                                   int height_px) noexcept {
  const glm::dvec4 clip = projection.clip_from_eye * (projection.eye_from_lps * glm::dvec4(place_lps_mm, 1.0));
  if (!(clip.w > 0.0)) return std::nullopt;
  return glm::dvec2(0.5 * (1.0 + clip.x / clip.w) * width_px, 0.5 * (1.0 - clip.y / clip.w) * height_px);
}

}  // namespace seldinger::imaging
