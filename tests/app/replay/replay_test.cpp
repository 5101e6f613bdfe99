// What a replay draws: canvas, planes of the body, and the screen as it was held.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "app/replay/body_planes.h"
#include "app/replay/canvas.h"
#include "app/replay/png.h"
#include "assessment/score.h"
#include "session/attempt/replayed_attempt.h"
#include "session/guidance/guidance.h"
#include "session/guidance/slice_picture.h"
#include "session/monitor/guidance_screen.h"
#include "sim/engine/step.h"
#include "tests/fixtures/ball_case.h"

namespace seldinger::app {
namespace {

cases::Case ball(cases::Modality modality) {
  cases::Case scene = fixtures::ball_case({88, 2.5, 100.0, 40.0, 6});
  scene.lesions.push_back({{0.0, -60.0, 0.0}, 6.0, 500.0});
  scene.structures.push_back({"duct", {}, cases::StructureRule::critical, cases::Sphere{{0.0, -62.0, 0.0}, 15.0}});
  scene.structures.push_back({"elsewhere", {}, cases::StructureRule::major, cases::Sphere{{80.0, 0.0, 50.0}, 5.0}});
  scene.picture.modality = modality;
  return scene;
}

std::array<int, 3> pixel(const Canvas& canvas, int x, int y) {
  const auto at = static_cast<std::size_t>(3 * (y * canvas.width_px() + x));
  return {canvas.rgb()[at], canvas.rgb()[at + 1], canvas.rgb()[at + 2]};
}

TEST(Png, InFewGreysTheEndsStayAndSpeckleWeighsLess) {
  std::vector<unsigned char> ends = {0, 255, 7, 9}, speckle;
  unsigned state = 1;
  for (int i = 0; i < 64 * 64; ++i)
    speckle.push_back(static_cast<unsigned char>((state = state * 1664525U + 1) >> 24));
  EXPECT_LT(2 * png_in_greys(speckle, 64, 64, 16).size(), 5 * png_from_grey(speckle, 64, 64).size() / 4);
  const std::vector<unsigned char> nearest = {0, 255, 0, 17};
  EXPECT_EQ(png_in_greys(ends, 2, 2, 16), png_in_greys(nearest, 2, 2, 16));
}

TEST(Canvas, DrawsWithinItsEdges) {
  Canvas canvas(40, 30, {1, 2, 3});
  canvas.fill({-5, -5, 10, 10}, {255, 0, 0});
  EXPECT_EQ(pixel(canvas, 4, 4), (std::array<int, 3>{255, 0, 0}));
  EXPECT_EQ(pixel(canvas, 5, 5), (std::array<int, 3>{1, 2, 3}));
  canvas.line({-1e6, 20.0}, {1e6, 20.0}, 1.0, {0, 255, 0});
  EXPECT_EQ(pixel(canvas, 0, 20), (std::array<int, 3>{0, 255, 0}));
  EXPECT_EQ(pixel(canvas, 39, 20), (std::array<int, 3>{0, 255, 0}));
  EXPECT_EQ(pixel(canvas, 20, 23), (std::array<int, 3>{1, 2, 3}));
  canvas.line({std::nan(""), 0.0}, {1.0, 1.0}, 1.0, {9, 9, 9});
  canvas.circle({0.0, 0.0}, 100.0, 2.0, {9, 9, 9});
  canvas.text(-3, 26, 2, "m\xC3\xA9", {255, 255, 255});
}

TEST(Canvas, ASteepLineIsAsWideAsAFlatOne) {
  Canvas canvas(100, 100, {});
  canvas.line({50.0, 0.0}, {50.0, 99.0}, 3.0, {200, 200, 200});
  Canvas flat(100, 100, {});
  flat.line({0.0, 50.0}, {99.0, 50.0}, 3.0, {200, 200, 200});
  for (int i = 40; i < 60; ++i) EXPECT_EQ(pixel(canvas, i, 50), pixel(flat, 50, i)) << i;
  EXPECT_EQ(pixel(canvas, 51, 50)[0], 200);
  EXPECT_EQ(pixel(canvas, 53, 50)[0], 0);
}

TEST(Canvas, APictureKeepsItsShapeAndGreys) {
  session::GreyPicture grey{std::vector<unsigned char>(20 * 10, 77), 20, 10};
  Canvas canvas(100, 100, {});
  const Rectangle at = canvas.picture({0, 0, 100, 100}, grey);
  EXPECT_EQ(at.width, 100);
  EXPECT_EQ(at.height, 50);
  EXPECT_EQ(at.top, 25);
  EXPECT_EQ(pixel(canvas, 50, 30), (std::array<int, 3>{77, 77, 77}));
  EXPECT_EQ(pixel(canvas, 50, 20), (std::array<int, 3>{0, 0, 0}));
  EXPECT_EQ(canvas.picture({0, 0, 10, 10}, {}).width, 0);
}

TEST(GreyPictures, LoseOnlyTheEdgesThatAllHaveBlack) {
  const auto lit = [](int width, int height, std::vector<std::pair<int, int>> places) {
    session::GreyPicture picture{std::vector<unsigned char>(static_cast<std::size_t>(width * height)), width,
                                 height};
    for (const auto& [x, y] : places) picture.grey[static_cast<std::size_t>(y * width + x)] = 9;
    return picture;
  };
  std::vector<session::GreyPicture> pictures = {{}, lit(8, 6, {{2, 3}}), lit(8, 6, {{5, 1}}), lit(4, 4, {{1, 1}})};
  session::cut_black_edges(pictures);
  EXPECT_EQ(pictures[0].width_px, 0);
  for (const int i : {1, 2}) {
    EXPECT_EQ(pictures[static_cast<std::size_t>(i)].width_px, 4);
    EXPECT_EQ(pictures[static_cast<std::size_t>(i)].height_px, 3);
  }
  EXPECT_EQ(pictures[1].grey[2 * 4 + 0], 9);
  EXPECT_EQ(pictures[2].grey[0 * 4 + 3], 9);
  EXPECT_EQ(pictures[3].width_px, 4);
  std::vector<session::GreyPicture> black = {lit(3, 3, {})};
  session::cut_black_edges(black);
  EXPECT_EQ(black[0].width_px, 3);
}

TEST(GreyPictures, ShrinkToMeansOfSquares) {
  // 5 × 4, each pixel ten times its column and its row: the last column is left over.
  session::GreyPicture picture{{}, 5, 4};
  for (int y = 0; y < 4; ++y)
    for (int x = 0; x < 5; ++x) picture.grey.push_back(static_cast<unsigned char>(10 * (x + y)));
  const session::GreyPicture small = session::shrunk_to(picture, 3);
  EXPECT_EQ(small.width_px, 2);
  EXPECT_EQ(small.height_px, 2);
  EXPECT_EQ(small.grey, (std::vector<unsigned char>{10, 30, 30, 50}));
  EXPECT_EQ(session::shrunk_to(picture, 5).grey, picture.grey) << "as it is where it fits";
  EXPECT_EQ(session::shrunk_to({}, 3).width_px, 0);
}

assessment::Signals signals_in(const cases::Case& scene) {
  cases::Recording recording;
  for (int i = 0; i <= 200; ++i) {
    cases::PoseSample pose;
    pose.t_s = 0.01 * i;
    pose.tip_lps_mm = {0.0, -120.0 + 0.3 * i, 0.0};
    pose.needle_direction = {0.0, 1.0, 0.0};
    recording.poses.push_back(pose);
  }
  auto signals = assessment::signals_of(scene, recording);
  EXPECT_TRUE(signals);
  return std::move(*signals);
}

TEST(BodyPlanes, CutSkinAndStructuresThroughTheTarget) {
  const cases::Case scene = ball(cases::Modality::mpr);
  const auto signals = signals_in(scene);
  const auto planes = body_planes(scene, signals);
  ASSERT_EQ(planes.size(), 3U);
  for (const BodyPlane& plane : planes) {
    const glm::dvec3 target = scene.lesions[0].center_lps_mm;
    EXPECT_NEAR(glm::dot(plane.corner_lps_mm - target, glm::cross(plane.u, plane.v)), 0.0, 1e-9) << plane.name;
    EXPECT_EQ(plane.side_mm, planes[0].side_mm);
    // The grey of the target's middle is the lesion's, beside it the ball's.
    const auto grey = [&](const glm::dvec3& at) {
      const glm::dvec2 px = plane.at(at) * (plane.ct.width_px / plane.side_mm);
      return plane.ct
          .grey[static_cast<std::size_t>(static_cast<int>(px.y) * plane.ct.width_px + static_cast<int>(px.x))];
    };
    EXPECT_EQ(grey(target), 255) << plane.name;
    EXPECT_EQ(grey(target + 9.0 * plane.u), 128) << plane.name;
    // Every end of the skin's cut lies on the sphere, which the mesh does to 0.1 mm.
    for (const PlaneSegment& segment : plane.skin)
      for (const glm::dvec2& end : {segment.from_mm, segment.to_mm})
        EXPECT_NEAR(glm::length(plane.corner_lps_mm + end.x * plane.u + end.y * plane.v), 100.0, 0.1);
    // The duct's outline: all of it about its radius there, all around.
    ASSERT_EQ(plane.structures.size(), 1U) << plane.name;
    EXPECT_EQ(plane.structures[0].name, "duct");
    const double away_mm = std::abs(glm::dot(target - glm::dvec3(0.0, -62.0, 0.0), glm::cross(plane.u, plane.v)));
    const double radius_mm = std::sqrt(225.0 - away_mm * away_mm), pixel_mm = plane.side_mm / 160.0;
    double way_mm = 0.0;
    for (const PlaneSegment& segment : plane.structures[0].segments) {
      EXPECT_NEAR(glm::length(segment.from_mm - plane.at({0.0, -62.0, 0.0})), radius_mm, 1.5 * pixel_mm);
      way_mm += glm::length(segment.to_mm - segment.from_mm);
    }
    EXPECT_NEAR(way_mm, 8.0 * radius_mm, 8.0 * pixel_mm) << "a circle of pixels is as long as its square";
  }
  EXPECT_FALSE(planes[0].skin.empty());
}

// A fluoroscope without a pulse shows nothing, after its pulse that picture is held.
TEST(GuidanceScreen, HoldsTheLastImage) {
  const cases::Case scene = ball(cases::Modality::xray);
  session::GuidanceScreen screen(scene, 1);
  cases::State state;
  cases::Inputs inputs;
  inputs.needle.position_lps_mm = {0.0, -110.0, 0.0};
  const auto run = [&](int ticks, bool pedal) {
    inputs.fluoroscope.pedal = pedal;
    for (int i = 0; i < ticks; ++i) {
      engine::step(scene, inputs, base::kTickS, state);
      screen.tick(state, {});
    }
  };
  run(10, false);
  EXPECT_EQ(screen.picture().width_px, 0);
  EXPECT_FALSE(screen.live());
  run(1, true);
  EXPECT_TRUE(screen.live());
  const session::GreyPicture shown = screen.picture();
  EXPECT_EQ(shown.width_px, scene.fluoroscope.picture_px);
  inputs.needle.position_lps_mm = {0.0, -60.0, 0.0};
  run(500, false);
  EXPECT_FALSE(screen.live());
  EXPECT_EQ(screen.picture().grey, shown.grey);
  run(1, true);
  EXPECT_NE(screen.picture().grey, shown.grey);
}

TEST(GuidanceScreen, AFrozenPictureStays) {
  const cases::Case scene = ball(cases::Modality::mpr);
  session::GuidanceScreen screen(scene, 1);
  cases::State state;
  cases::Inputs inputs;
  inputs.probe.position_lps_mm = {0.0, -100.0, 0.0};
  inputs.probe.axis = {0.0, 1.0, 0.0};
  const auto run = [&](bool freeze) {
    inputs.freeze = freeze;
    for (int i = 0; i < 100; ++i) {
      engine::step(scene, inputs, base::kTickS, state);
      screen.tick(state, {});
    }
  };
  run(false);
  EXPECT_TRUE(screen.live());
  const session::GreyPicture before = screen.picture();
  ASSERT_GT(before.width_px, 0);
  inputs.probe.position_lps_mm.x = 30.0;
  run(true);
  EXPECT_FALSE(screen.live());
  EXPECT_EQ(screen.picture().grey, before.grey);
  run(false);
  EXPECT_NE(screen.picture().grey, before.grey);
}

TEST(GuidanceScreen, ASliceBesideTheProbeIsWhatIsShownAndTold) {
  const cases::Case scene = ball(cases::Modality::mpr);
  session::GuidanceScreen screen(scene, 1);
  const auto guidance = session::guidance_of(scene);
  const auto see = [&](const cases::State& now, const tissue::Displacement& displacement) {
    return guidance->see(now, displacement);
  };
  cases::State state;
  cases::Inputs inputs;
  inputs.probe = {{0.0, -100.0, 0.0}, {0.0, 1.0, 0.0}, {1.0, 0.0, 0.0}};
  inputs.needle = {{0.0, -60.0, 0.0}, {0.0, 1.0, 0.0}, {1.0, 0.0, 0.0}};
  const auto run = [&](double slice_mm) {
    inputs.console.slice_mm = slice_mm;
    for (int i = 0; i < 100; ++i) {
      engine::step(scene, inputs, base::kTickS, state);
      screen.tick(state, {});
    }
    return screen.picture();
  };
  const session::GreyPicture plane = run(0.0);
  EXPECT_TRUE(see(state, {}).joint());
  const session::GreyPicture beside = run(30.0);
  EXPECT_NE(beside.grey, plane.grey);
  EXPECT_FALSE(see(state, {}).target || see(state, {}).needle_tip);
  // axial × lateral is −z: the slice of a probe that is held there.
  inputs.probe.position_lps_mm.z = -30.0;
  EXPECT_EQ(run(0.0).grey, beside.grey);
  inputs.probe.position_lps_mm.z = -session::kMostSliceMm;
  const session::GreyPicture furthest = run(0.0);
  inputs.probe.position_lps_mm.z = 0.0;
  EXPECT_EQ(run(1e6).grey, furthest.grey);
  EXPECT_EQ(run(0.0).grey, plane.grey);
}

TEST(SlicePicture, AWindowIsWhatIsBlackAndWhite) {
  const cases::Case scene = ball(cases::Modality::mpr);
  cases::PoseSample pose;
  pose.probe_origin_lps_mm = {0.0, -100.0, 0.0};
  pose.probe_axial = {0.0, 1.0, 0.0};
  pose.probe_lateral = {1.0, 0.0, 0.0};
  const imaging::NeedlePose away{{500.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, 100.0, 0.36, 0.0, 3000.0};
  const auto at_80_mm = [&](const session::HuWindow& window) {
    const session::GreyPicture picture = session::slice_under_probe(scene, pose, {}, away, {}, window);
    const int row = static_cast<int>(80.0 / session::kSlicePixelMm);
    return static_cast<int>(picture.grey[static_cast<std::size_t>(row * picture.width_px + picture.width_px / 2)]);
  };
  for (const session::HuWindow& window : session::kHuWindows)  // tissue of 40 HU
    EXPECT_NEAR(at_80_mm(window),
                std::clamp(255.0 * (40.0 - window.center_hu + 0.5 * window.width_hu) / window.width_hu, 0.0, 255.0),
                1.0)
        << window.name;
}

TEST(Replay, IsSeenUpToTheFirstDifferenceAndThroughWhatCannotBeCompared) {
  const cases::Case scene = ball(cases::Modality::xray);
  cases::Recording recording;
  recording.step_version = engine::kStepVersion;
  recording.dt_s = base::kTickS;
  cases::State state;
  std::uint64_t hash = 0;
  for (int i = 0; i < 50; ++i) {
    cases::Inputs inputs;
    inputs.needle.position_lps_mm = {0.1 * i, -110.0, 0.0};
    engine::step(scene, inputs, recording.dt_s, state);
    hash = cases::state_hash(state, hash);
    recording.inputs.push_back(inputs);
    recording.hashes.push_back(static_cast<std::uint32_t>(hash));
    if (i % 10 == 0)
      recording.poses.push_back({state.t_s, state.needle.tip_lps_mm, state.needle.direction,
                                 state.probe.origin_lps_mm, state.probe.axial, state.probe.lateral});
  }
  std::uint64_t last = 0;
  const auto seen = [&](const cases::State& now, const tissue::Displacement&) { last = now.tick; };
  EXPECT_TRUE(session::replay(scene, recording, seen).same);
  EXPECT_EQ(last, 50U);
  recording.hashes[29] ^= 1U;
  const session::Replay other = session::replay(scene, recording, seen);
  EXPECT_FALSE(other.same);
  EXPECT_EQ(other.first_difference_tick, 30U);
  EXPECT_EQ(last, 29U);
  recording.step_version = engine::kStepVersion + 1;
  EXPECT_FALSE(session::replay(scene, recording, seen).same);
  EXPECT_EQ(last, 50U);
}

}  // namespace
}  // namespace seldinger::app
