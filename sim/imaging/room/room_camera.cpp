#include "sim/imaging/room/room_camera.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>
#include <numbers>

#include "sim/base/check.h"

namespace seldinger::imaging {
namespace {

constexpr double kRadians = std::numbers::pi / 180.0;

double far_of(double distance_mm) {
  return distance_mm + 8000.0;  // the room's far corner
}

glm::dmat3 axes_of(const RoomCamera& camera) {
  const glm::dvec3 back = glm::normalize(camera.eye_lps_mm - camera.target_lps_mm);
  const glm::dvec3 right = glm::normalize(glm::cross(camera.up, back));
  return {right, glm::cross(back, right), back};
}

// Möller and Trumbore, J. Graphics Tools 2 (1997) 21: whether the way from `from` to `to` goes through a triangle.
bool crosses(const glm::dvec3& from, const glm::dvec3& to, const glm::dvec3& a, const glm::dvec3& b,
             const glm::dvec3& c) {
  const glm::dvec3 way = to - from, u = b - a, v = c - a, p = glm::cross(way, v);
  const double det = glm::dot(u, p);
  if (det == 0.0) return false;
  const glm::dvec3 s = (from - a) / det, q = glm::cross(s, u);
  const double share_u = glm::dot(s, p), share_v = glm::dot(way, q), at = glm::dot(v, q);
  return share_u >= 0.0 && share_v >= 0.0 && share_u + share_v <= 1.0 && at > 0.0 && at < 1.0;
}

// How many of these places the probe hides from the eye.
int behind_probe(const RoomMesh& form, const cases::ProbeState& probe, const glm::dvec3& eye,
                 std::span<const glm::dvec3> places) {
  const glm::dmat3 lps_from_probe(probe.lateral, glm::cross(probe.axial, probe.lateral), probe.axial);
  const auto here = [&](const glm::dvec3& p) { return glm::transpose(lps_from_probe) * (p - probe.origin_lps_mm); };
  const glm::dvec3 from = here(eye);
  int hidden = 0;
  for (const glm::dvec3& place : places)
    hidden += std::any_of(form.triangles.begin(), form.triangles.end(),
                          [&, to = here(place)](const glm::uvec3& t) {
                            return crosses(from, to, glm::dvec3(form.vertices[t.x].place_mm),
                                           glm::dvec3(form.vertices[t.y].place_mm),
                                           glm::dvec3(form.vertices[t.z].place_mm));
                          })
                  ? 1
                  : 0;
  return hidden;
}

// About the target to where the probe hides least of the needle, by no more than is needed.
void look_past_probe(RoomCamera& camera, const RoomModel& room, const cases::ProbeState& probe,
                     std::span<const glm::dvec3> places) {
  const RoomCamera asked = camera;
  int least = behind_probe(room.meshes[room.probe], probe, camera.eye_lps_mm, places);
  for (const double up_deg : {0.0, 15.0})
    for (const double right_deg : {15.0, -15.0, 30.0, -30.0, 45.0, -45.0, 60.0, -60.0}) {
      if (least == 0) return;
      RoomCamera turned = asked;
      orbit(turned, room.frame, right_deg, up_deg);
      const int hidden = behind_probe(room.meshes[room.probe], probe, turned.eye_lps_mm, places);
      if (hidden >= least) continue;
      least = hidden;
      camera = turned;
    }
}

}  // namespace

std::optional<RoomView> room_view_named(std::string_view name) noexcept {
  for (std::size_t i = 0; i < kRoomViewNames.size(); ++i)
    if (kRoomViewNames[i] == name) return static_cast<RoomView>(i);
  return std::nullopt;
}

RoomCamera room_camera(const RoomModel& room, const cases::Case& scene, const cases::State& state, RoomView view) {
  const RoomFrame& f = room.frame;
  RoomCamera camera;
  camera.up = f.up;
  const glm::dvec3 needle = state.needle.direction, tip = state.needle.tip_lps_mm;
  glm::dvec3 site = scene.planned_entry_lps_mm ? *scene.planned_entry_lps_mm : tip;
  if (state.needle.skin.in_body) site = state.needle.skin.entry_lps_mm;
  const double side = operator_side(f, scene);
  const glm::dvec3 hub = tip - needle * (scene.instrument.length_mm + 30.0);
  // Between the way in and the hand, nearer to what the hand works at.
  const bool at_work = view == RoomView::operator_side || view == RoomView::head_end || view == RoomView::foot_end;
  camera.target_lps_mm = at_work ? glm::mix(site, hub, 0.3) : site;
  const auto from = [&](double across, double head, double up, double distance_mm) {
    camera.eye_lps_mm =
        camera.target_lps_mm + distance_mm * glm::normalize(f.across * across + f.head * head + f.up * up);
  };
  switch (view) {
    case RoomView::operator_side:
      from(side, -0.25, 0.75, 560.0);
      break;
    case RoomView::head_end:
      from(0.15 * side, 1.0, 0.7, 620.0);
      break;
    case RoomView::foot_end:
      from(0.15 * side, -1.0, 0.7, 620.0);
      break;
    case RoomView::top:
      camera.up = f.head;
      from(0.0, 0.0, 1.0, 650.0);
      break;
    case RoomView::over_needle:
      from(0.45 * side, -0.2, 0.9, 420.0);
      break;
    case RoomView::along_needle:
      camera.eye_lps_mm = tip - needle * (scene.instrument.length_mm + 260.0) + f.up * 40.0;
      break;
    case RoomView::along_plane: {
      constexpr double kAbove = 0.5;  // of the way along the plane: past the needle's hub
      const cases::ProbeState& probe = state.probe;
      const double needle_side = glm::dot(hub - probe.origin_lps_mm, probe.lateral) < 0.0 ? -1.0 : 1.0;
      camera.target_lps_mm = probe.origin_lps_mm;
      camera.up = -probe.axial;
      camera.eye_lps_mm =
          probe.origin_lps_mm + 420.0 * glm::normalize(needle_side * probe.lateral - kAbove * probe.axial);
      break;
    }
    case RoomView::near_probe:
      camera.target_lps_mm = state.probe.origin_lps_mm;
      from(side, -0.7, 0.6, 380.0);
      break;
  }
  const glm::dvec3 back = camera.eye_lps_mm - camera.target_lps_mm;
  if (glm::length(glm::cross(camera.up, back)) < 0.05 * glm::length(back)) camera.up = f.head;
  const glm::dvec3 in_view[] = {site, hub};
  stay_clear(camera, f, scene.skin_index, in_view, 1.0);
  const double length_mm = scene.instrument.length_mm;
  const glm::dvec3 seen[] = {site, tip - 0.02 * length_mm * needle, tip - 0.2 * length_mm * needle,
                             tip - 0.5 * length_mm * needle};
  if (room.probe != kNoMesh && (at_work || view == RoomView::over_needle)) {
    look_past_probe(camera, room, state.probe, seen);
    stay_clear(camera, f, scene.skin_index, in_view, 1.0);
  }
  stay_off_tools(camera, room, state);
  return camera;
}

void stay_clear(RoomCamera& camera, const RoomFrame& frame, const cases::MeshIndex& skin,
                std::span<const glm::dvec3> in_view, double width_per_height) {
  constexpr double kFromSkinMm = 60.0, kFromFloorMm = 150.0, kFarthestMm = 2400.0, kInside = 0.9, kStep = 1.04;
  const auto too_low_mm = [&] { return frame.floor_mm + kFromFloorMm - glm::dot(camera.eye_lps_mm, frame.up); };
  if (too_low_mm() > 0.0) camera.eye_lps_mm += frame.up * too_low_mm();
  const auto distance_mm = [&] { return glm::distance(camera.eye_lps_mm, camera.target_lps_mm); };
  const auto blocked = [&] {
    if (!skin.empty() && skin.closest(camera.eye_lps_mm).distance_mm < kFromSkinMm) return true;
    const RoomProjection projection = projection_of(camera, 0, width_per_height);
    return std::any_of(in_view.begin(), in_view.end(), [&](const glm::dvec3& place) {
      const glm::dvec4 clip = projection.clip_from_eye * (projection.eye_from_lps * glm::dvec4(place, 1.0));
      return !(std::abs(clip.x) <= kInside * clip.w && std::abs(clip.y) <= kInside * clip.w);
    });
  };
  while (distance_mm() * kStep < kFarthestMm && blocked()) {
    zoom(camera, kStep);
    if (too_low_mm() > 0.0) camera.eye_lps_mm += frame.up * too_low_mm();
  }
}

void stay_off_tools(RoomCamera& camera, const RoomModel& room, const cases::State& state) {
  constexpr double kFromToolMm = 60.0, kFarthestMm = 2400.0, kStep = 1.04;
  const glm::dmat3 lps_from_probe(state.probe.lateral, glm::cross(state.probe.axial, state.probe.lateral),
                                  state.probe.axial);
  const auto near_probe = [&] {
    if (room.probe == kNoMesh) return false;
    const glm::dvec3 eye = glm::transpose(lps_from_probe) * (camera.eye_lps_mm - state.probe.origin_lps_mm);
    return std::ranges::any_of(room.meshes[room.probe].vertices, [&](const gpu::Vertex& vertex) {
      return glm::distance(glm::dvec3(vertex.place_mm), eye) < kFromToolMm;
    });
  };
  // The hub and what is held of it, by its length: it is slender.
  double hub_end_mm = 0.0;
  if (room.hub != kNoMesh)
    for (const gpu::Vertex& vertex : room.meshes[room.hub].vertices)
      hub_end_mm = std::min(hub_end_mm, static_cast<double>(vertex.place_mm.z));
  const auto near_hub = [&] {
    const glm::dvec3 from_tip = camera.eye_lps_mm - state.needle.tip_lps_mm;
    const double along_mm = std::clamp(glm::dot(from_tip, state.needle.direction), hub_end_mm, 0.0);
    return glm::distance(from_tip, along_mm * state.needle.direction) < kFromToolMm;
  };
  while (glm::distance(camera.eye_lps_mm, camera.target_lps_mm) * kStep < kFarthestMm &&
         (near_probe() || near_hub()))
    zoom(camera, kStep);
}

RoomCamera between(const RoomCamera& from, const RoomCamera& to, double share) {
  const double t = std::clamp(share, 0.0, 1.0), eased = t * t * (3.0 - 2.0 * t);
  if (eased == 0.0) return from;
  if (eased == 1.0) return to;
  const glm::dvec3 a = from.eye_lps_mm - from.target_lps_mm, b = to.eye_lps_mm - to.target_lps_mm;
  const glm::dmat3 axes_a = axes_of(from), axes_b = axes_of(to);
  const glm::dquat turn = glm::slerp(glm::quat_cast(axes_a), glm::quat_cast(axes_b), eased);
  RoomCamera camera = from;
  camera.target_lps_mm = glm::mix(from.target_lps_mm, to.target_lps_mm, eased);
  camera.eye_lps_mm = camera.target_lps_mm + turn * glm::dvec3(0.0, 0.0, 1.0) *
                                                 std::pow(glm::length(a), 1.0 - eased) *
                                                 std::pow(glm::length(b), eased);
  camera.up = turn * glm::dvec3(0.0, 1.0, 0.0);
  camera.height_deg = glm::mix(from.height_deg, to.height_deg, eased);
  camera.eye_separation_mm = glm::mix(from.eye_separation_mm, to.eye_separation_mm, eased);
  return camera;
}

void orbit(RoomCamera& camera, const RoomFrame& frame, double right_deg, double up_deg) {
  const double distance_mm = glm::distance(camera.eye_lps_mm, camera.target_lps_mm);
  const glm::dvec3 back = (camera.eye_lps_mm - camera.target_lps_mm) / distance_mm;
  const double rise = std::asin(std::clamp(glm::dot(back, frame.up), -1.0, 1.0));
  const double round = std::atan2(glm::dot(back, frame.head), glm::dot(back, frame.across)) + kRadians * right_deg;
  const double risen = std::clamp(rise + kRadians * up_deg, -80.0 * kRadians, 85.0 * kRadians);
  camera.eye_lps_mm =
      camera.target_lps_mm + distance_mm * frame.lps(std::cos(risen) * std::cos(round),
                                                     std::cos(risen) * std::sin(round), std::sin(risen));
  camera.up = frame.up;
}

void pan(RoomCamera& camera, double right, double up) {
  const glm::dmat3 axes = axes_of(camera);
  const double height_mm =
      2.0 * std::tan(0.5 * kRadians * camera.height_deg) * glm::distance(camera.eye_lps_mm, camera.target_lps_mm);
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
  constexpr double near_mm = 5.0;  // nothing that is looked at comes as near: stay_clear, stay_off_tools
  const double half_height = near_mm * std::tan(0.5 * kRadians * camera.height_deg);
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

glm::dvec3 ray_of(const RoomProjection& projection, const glm::dvec2& pixel, int width_px, int height_px) noexcept {
  const glm::dvec4 clip(2.0 * pixel.x / width_px - 1.0, 1.0 - 2.0 * pixel.y / height_px, 0.0, 1.0);
  const glm::dvec4 place = glm::inverse(projection.clip_from_eye * projection.eye_from_lps) * clip;
  return glm::normalize(glm::dvec3(place) / place.w - projection.eye_lps_mm);
}

}  // namespace seldinger::imaging
