// Cameras against closed forms.
#include "sim/imaging/room/room_camera.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "sim/imaging/room/draw_list.h"
#include "tests/sim/imaging/room/room_fixture.h"

namespace seldinger::imaging {
namespace {

constexpr double kTan = 0.5;  // of half the height

RoomCamera straight() {
  RoomCamera camera;
  camera.eye_lps_mm = {0.0, 0.0, 1000.0};
  camera.target_lps_mm = {0.0, 0.0, 0.0};
  camera.up = {0.0, 1.0, 0.0};
  camera.height_deg = 2.0 * std::atan(kTan) * 180.0 / std::numbers::pi;
  return camera;
}

TEST(RoomCamera, CastsPlacesWhereSimilarTrianglesSay) {
  const RoomProjection p = projection_of(straight(), 0, 2.0);
  // 400 to the right and 250 up at the target's distance; half the picture is 500 mm high and 1000 mm wide there.
  const auto pixel = pixel_of(p, {400.0, 250.0, 0.0}, 800, 400);
  ASSERT_TRUE(pixel);
  EXPECT_NEAR(pixel->x, 400.0 + 400.0 * 400.0 / 1000.0, 1e-9);
  EXPECT_NEAR(pixel->y, 200.0 - 200.0 * 250.0 / 500.0, 1e-9);
  // Half as far, twice as large.
  EXPECT_NEAR(pixel_of(p, {200.0, 125.0, 500.0}, 800, 400)->x, pixel->x, 1e-9);
  EXPECT_FALSE(pixel_of(p, {0.0, 0.0, 1001.0}, 800, 400));
}

TEST(RoomCamera, APairHasNoParallaxAtTheTargetAndCrossedBeforeIt) {
  const RoomCamera camera = straight();
  const RoomProjection left = projection_of(camera, -1, 1.0), right = projection_of(camera, 1, 1.0);
  EXPECT_NEAR(glm::distance(left.eye_lps_mm, right.eye_lps_mm), 63.0, 1e-9);
  constexpr int kPx = 1000;
  const auto parallax_px = [&](double z) {
    const glm::dvec3 place(30.0, -20.0, z);
    const auto l = pixel_of(left, place, kPx, kPx), r = pixel_of(right, place, kPx, kPx);
    EXPECT_NEAR(l->y, r->y, 1e-9);  // eyes are never asked to look up and down at once
    return r->x - l->x;
  };
  EXPECT_NEAR(parallax_px(0.0), 0.0, 1e-9);
  // b (1/D − 1/d), times the focal length in pixels.
  for (const double z : {500.0, 200.0, -500.0}) {
    const double focal_px = 0.5 * kPx / kTan;
    EXPECT_NEAR(parallax_px(z), 63.0 * focal_px * (1.0 / 1000.0 - 1.0 / (1000.0 - z)), 1e-9) << z;
  }
  EXPECT_LT(parallax_px(200.0), 0.0);
  EXPECT_GT(parallax_px(-200.0), 0.0);
}

TEST(RoomCamera, PresetsSeeHubAndEntryFromOutsideHoweverThePatientLies) {
  for (const auto position : {cases::PatientPosition::supine, cases::PatientPosition::prone,
                              cases::PatientPosition::lateral_left, cases::PatientPosition::lateral_right}) {
    cases::Case scene = ball_case();
    scene.position = position;
    const glm::dvec3 up = cases::upwards(position);
    scene.planned_entry_lps_mm = up * kBallMm;
    cases::State state = ball_state();
    state.needle.tip_lps_mm = *scene.planned_entry_lps_mm;
    state.needle.direction = glm::normalize(-up + 0.4 * glm::dvec3(0.0, 0.0, 1.0));
    state.probe.origin_lps_mm = *scene.planned_entry_lps_mm + 30.0 * glm::dvec3(0.0, 0.0, 1.0);
    state.probe.axial = -up;
    const RoomModel room = make_room_model(scene);
    for (std::size_t i = 0; i < kRoomViewNames.size(); ++i) {
      SCOPED_TRACE(std::string(kRoomViewNames[i]) + " " + std::to_string(static_cast<int>(position)));
      const RoomCamera camera = room_camera(room, scene, state, static_cast<RoomView>(i));
      EXPECT_EQ(room_view_named(kRoomViewNames[i]), static_cast<RoomView>(i));
      EXPECT_GT(scene.skin_index.closest(camera.eye_lps_mm).distance_mm, 50.0);
      EXPECT_GT(glm::dot(camera.eye_lps_mm, up), room.frame.floor_mm + 100.0);
      const RoomProjection p = projection_of(camera, 0, 1.0);
      for (const glm::dvec3& place :
           {*scene.planned_entry_lps_mm,
            state.needle.tip_lps_mm - state.needle.direction * scene.instrument.length_mm}) {
        const auto pixel = pixel_of(p, place, 100, 100);
        ASSERT_TRUE(pixel);
        EXPECT_GT(std::min(pixel->x, pixel->y), 0.0);
        EXPECT_LT(std::max(pixel->x, pixel->y), 100.0);
      }
    }
    const RoomCamera side = room_camera(room, scene, state, RoomView::operator_side);
    EXPECT_LT(glm::dot(side.eye_lps_mm, room.frame.across), -100.0);  // nothing speaks for the other side
    EXPECT_GT(glm::dot(room_camera(room, scene, state, RoomView::head_end).eye_lps_mm, room.frame.head), 300.0);
    EXPECT_LT(glm::dot(room_camera(room, scene, state, RoomView::foot_end).eye_lps_mm, room.frame.head), -300.0);
  }
}

// How near the line of sight to a place comes to the axis of the probe's case.
double past_probe_mm(const glm::dvec3& eye, const glm::dvec3& place, const cases::ProbeState& probe) {
  double nearest_mm = 1e9;
  for (int i = 0; i <= 400; ++i)
    for (int j = 0; j <= 30; ++j)
      nearest_mm = std::min(
          nearest_mm, glm::distance(glm::mix(eye, place, i / 400.0), probe.origin_lps_mm - 5.0 * j * probe.axial));
  return nearest_mm;
}

TEST(RoomCamera, PresetsLookPastTheProbeAtTheNeedle) {
  cases::Case scene = ball_case();
  const RoomModel room = make_room_model(scene);
  const RoomFrame& f = room.frame;
  cases::State state = ball_state();
  state.needle.tip_lps_mm = *scene.planned_entry_lps_mm + 2.0 * f.up;
  state.needle.direction = -f.up;
  state.probe.axial = -f.up;
  state.probe.lateral = f.head;
  for (const RoomView view : {RoomView::operator_side, RoomView::over_needle}) {
    SCOPED_TRACE(kRoomViewNames[static_cast<std::size_t>(view)]);
    state.probe.origin_lps_mm = *scene.planned_entry_lps_mm + 200.0 * f.head;  // out of the way
    const RoomCamera free = room_camera(room, scene, state, view);
    const glm::dvec3 middle = state.needle.tip_lps_mm + 0.2 * scene.instrument.length_mm * f.up;
    const glm::dvec3 towards = free.eye_lps_mm - *scene.planned_entry_lps_mm;
    const glm::dvec3 flat = glm::normalize(towards - glm::dot(towards, f.up) * f.up);
    state.probe.origin_lps_mm = *scene.planned_entry_lps_mm + 30.0 * flat;  // between
    ASSERT_LT(past_probe_mm(free.eye_lps_mm, middle, state.probe), 8.0);
    const RoomCamera camera = room_camera(room, scene, state, view);
    for (const glm::dvec3& place : {state.needle.tip_lps_mm, middle})
      EXPECT_GT(past_probe_mm(camera.eye_lps_mm, place, state.probe), 10.0);
    EXPECT_GT(glm::dot(glm::normalize(camera.eye_lps_mm - camera.target_lps_mm),
                       glm::normalize(free.eye_lps_mm - free.target_lps_mm)),
              0.4)
        << "from near by";
  }
}

TEST(RoomCamera, AlongThePlaneTheNeedleIsSeenBesideItAsFarAsItIs) {
  const cases::Case scene = ball_case();
  const RoomModel room = make_room_model(scene);
  cases::State state = ball_state();
  const glm::dvec3 normal = glm::cross(state.probe.axial, state.probe.lateral);
  for (const double side : {-1.0, 1.0}) {
    state.needle.direction = glm::normalize(state.probe.axial - side * state.probe.lateral);
    state.needle.tip_lps_mm = state.probe.origin_lps_mm + 10.0 * side * state.probe.lateral;
    const RoomCamera camera = room_camera(room, scene, state, RoomView::along_plane);
    EXPECT_NEAR(glm::dot(camera.eye_lps_mm - state.probe.origin_lps_mm, normal), 0.0, 1e-6) << "edge-on";
    EXPECT_GT(side * glm::dot(camera.eye_lps_mm - state.probe.origin_lps_mm, state.probe.lateral), 0.0)
        << "from the needle's side";
    const RoomProjection p = projection_of(camera, 0, 1.0);
    const double middle_px = pixel_of(p, state.probe.origin_lps_mm, 1000, 1000)->x;
    EXPECT_NEAR(pixel_of(p, state.probe.origin_lps_mm + 40.0 * state.probe.axial, 1000, 1000)->x, middle_px, 1e-6);
    EXPECT_GT(std::abs(pixel_of(p, state.needle.tip_lps_mm + 10.0 * normal, 1000, 1000)->x - middle_px), 10.0);
  }
}

TEST(RoomCamera, StaysOffTheToolsSoThatNoneIsCutByTheNearPlane) {
  const cases::Case scene = ball_case();
  const RoomModel room = make_room_model(scene);
  const cases::State state = ball_state();
  const glm::dmat3 lps_from_probe(state.probe.lateral, glm::cross(state.probe.axial, state.probe.lateral),
                                  state.probe.axial);
  RoomCamera camera = room_camera(room, scene, state, RoomView::near_probe);
  zoom(camera, 0.05);
  stay_off_tools(camera, room, state);
  const RoomProjection p = projection_of(camera, 0, 1.0);
  for (const gpu::Vertex& vertex : room.meshes[room.probe].vertices) {
    const glm::dvec3 place = state.probe.origin_lps_mm + lps_from_probe * glm::dvec3(vertex.place_mm);
    ASSERT_GE(glm::distance(place, camera.eye_lps_mm), 59.0);
    const glm::dvec4 clip = p.clip_from_eye * (p.eye_from_lps * glm::dvec4(place, 1.0));
    if (std::abs(clip.x) > clip.w || std::abs(clip.y) > clip.w) continue;  // not in the picture
    ASSERT_GT(clip.z, -clip.w) << "before the near plane";
  }
}

TEST(RoomCamera, StaysOutOfTheSkinAndAboveTheFloor) {
  const cases::Case scene = ball_case();
  const RoomModel room = make_room_model(scene);
  RoomCamera camera;
  camera.target_lps_mm = {0.0, 0.0, 0.0};
  camera.eye_lps_mm = {0.0, -30.0, 20.0};  // inside the ball
  camera.up = {0.0, 0.0, 1.0};
  stay_clear(camera, room.frame, scene.skin_index, {}, 1.0);
  EXPECT_GE(scene.skin_index.closest(camera.eye_lps_mm).distance_mm, 60.0);
  camera.eye_lps_mm = {0.0, 3000.0, 300.0};  // below the floor
  stay_clear(camera, room.frame, scene.skin_index, {}, 1.0);
  EXPECT_GE(glm::dot(camera.eye_lps_mm, room.frame.up), room.frame.floor_mm + 149.0);
}

TEST(RoomCamera, TurnsShiftsAndNearsAboutItsTarget) {
  const RoomModel room = make_room_model(ball_case());
  RoomCamera camera = room_camera(room, ball_case(), ball_state(), RoomView::operator_side);
  const RoomCamera before = camera;
  orbit(camera, room.frame, 40.0, 10.0);
  EXPECT_NEAR(glm::distance(camera.eye_lps_mm, camera.target_lps_mm),
              glm::distance(before.eye_lps_mm, before.target_lps_mm), 1e-9);
  const auto level = [&](const RoomCamera& c) {
    return glm::normalize(c.eye_lps_mm - c.target_lps_mm -
                          room.frame.up * glm::dot(c.eye_lps_mm - c.target_lps_mm, room.frame.up));
  };
  EXPECT_NEAR(glm::dot(level(camera), level(before)), std::cos(40.0 * std::numbers::pi / 180.0), 1e-9);
  orbit(camera, room.frame, -40.0, -10.0);
  EXPECT_NEAR(glm::distance(camera.eye_lps_mm, before.eye_lps_mm), 0.0, 1e-6);
  orbit(camera, room.frame, 0.0, 500.0);  // never over the top
  EXPECT_LT(glm::dot(glm::normalize(camera.eye_lps_mm - camera.target_lps_mm), room.frame.up), 0.9999);
  camera = before;
  zoom(camera, 0.5);
  EXPECT_NEAR(glm::distance(camera.eye_lps_mm, camera.target_lps_mm),
              0.5 * glm::distance(before.eye_lps_mm, before.target_lps_mm), 1e-9);
  camera = straight();
  pan(camera, 0.25, -0.5);  // shares of 1000 mm
  EXPECT_NEAR(glm::distance(camera.target_lps_mm, glm::dvec3(250.0, -500.0, 0.0)), 0.0, 1e-9);
  EXPECT_NEAR(glm::distance(camera.eye_lps_mm, glm::dvec3(250.0, -500.0, 1000.0)), 0.0, 1e-9);
}

TEST(RoomCamera, GoesFromOneToAnotherWithoutLeap) {
  const RoomCamera from = straight();
  RoomCamera to = straight();
  to.eye_lps_mm = {250.0, 0.0, 0.0};  // a quarter turn, and nearer
  to.height_deg = 30.0;
  EXPECT_EQ(between(from, to, 0.0).eye_lps_mm, from.eye_lps_mm);
  EXPECT_EQ(between(from, to, 1.0).eye_lps_mm, to.eye_lps_mm);
  const RoomCamera middle = between(from, to, 0.5);
  // Half of the turn, and the mean distance by ratio.
  EXPECT_NEAR(glm::distance(middle.eye_lps_mm, 500.0 * glm::normalize(glm::dvec3(1.0, 0.0, 1.0))), 0.0, 1e-9);
  EXPECT_NEAR(glm::length(middle.up), 1.0, 1e-12);
  glm::dvec3 last = from.eye_lps_mm;
  for (int i = 1; i <= 100; ++i) {
    const glm::dvec3 now = between(from, to, 0.01 * i).eye_lps_mm;
    EXPECT_LT(glm::distance(now, last), 25.0);
    last = now;
  }
}

}  // namespace
}  // namespace seldinger::imaging
