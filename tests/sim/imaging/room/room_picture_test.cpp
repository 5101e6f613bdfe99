// Pictures of the room, on whatever GL there is.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include "sim/imaging/room/room_renderer.h"
#include "tests/fixtures/failure_picture.h"
#include "tests/sim/imaging/room/room_fixture.h"

namespace seldinger::imaging {
namespace {

struct Rgb {
  int r = 0, g = 0, b = 0;
};

class RoomPictures : public ::testing::Test {
 protected:
  Rgb at(const std::vector<std::uint8_t>& rgba, int x, int y) const {
    const std::size_t i = static_cast<std::size_t>(4 * (y * asked.width_px + x));
    return {rgba.at(i), rgba.at(i + 1), rgba.at(i + 2)};
  }
  static bool is_skin(const Rgb& c) { return 100 * c.r > 125 * c.b; }

  std::vector<std::uint8_t> draw(RoomRenderer& renderer, const RoomModel& room) {
    make_draw_list(room, scene, state, options, list);
    renderer.draw(list, asked);
    last = {renderer.read_rgba(), asked.width_px, asked.height_px};
    return last.rgba;
  }
  void TearDown() override { fixtures::keep_if_failed(last.rgba, last.width_px, last.height_px); }

  gpu::Context context;
  cases::Case scene = ball_case();
  cases::State state = ball_state();
  RoomOptions options;
  DrawList list;
  RoomPicture asked;
  struct {
    std::vector<std::uint8_t> rgba;
    int width_px = 0, height_px = 0;
  } last;
};

TEST_F(RoomPictures, TheSkinIsWhereItsOutlineIsProjected) {
  const RoomModel room = make_room_model(scene);
  RoomRenderer renderer(context, room);
  asked.width_px = 320;
  asked.height_px = 240;
  asked.quality = {1, 1024, 512};
  // From the feet, level with the middle: the outline is seen against the walls, the tools are above it.
  asked.camera.eye_lps_mm = {0.0, 0.0, -900.0};
  asked.camera.up = {0.0, -1.0, 0.0};
  const auto rgba = draw(renderer, room);
  const RoomProjection projection =
      projection_of(asked.camera, 0, static_cast<double>(asked.width_px) / asked.height_px);
  // Where lines of sight touch the ball.
  const double touch_z = -kBallMm * kBallMm / 900.0;
  const double touch_r = std::sqrt(kBallMm * kBallMm - touch_z * touch_z);
  int seen = 0;
  for (int degrees = 0; degrees < 360; degrees += 5) {
    if (degrees > 225 && degrees < 315) continue;  // tools
    if (degrees > 45 && degrees < 135) continue;   // table
    const double angle = degrees * 3.14159265358979 / 180.0;
    const auto pixel = [&](double r) {
      return *pixel_of(projection, {r * std::cos(angle), r * std::sin(angle), touch_z}, asked.width_px,
                       asked.height_px);
    };
    const glm::dvec2 inside = pixel(touch_r - 6.0), outside = pixel(touch_r + 4.0);
    EXPECT_TRUE(is_skin(at(rgba, static_cast<int>(inside.x), static_cast<int>(inside.y)))) << degrees;
    EXPECT_FALSE(is_skin(at(rgba, static_cast<int>(outside.x), static_cast<int>(outside.y)))) << degrees;
    ++seen;
  }
  EXPECT_GT(seen, 30);
}

// Pixels that differ by more than `grey` in some colour, within [left, right).
std::vector<glm::ivec2> changed(const std::vector<std::uint8_t>& a, const std::vector<std::uint8_t>& b,
                                int width_px, int left, int right, int grey) {
  std::vector<glm::ivec2> pixels;
  const int height_px = static_cast<int>(a.size()) / 4 / width_px;
  for (int y = 0; y < height_px; ++y)
    for (int x = left; x < right; ++x) {
      int most = 0;
      for (int c = 0; c < 3; ++c) {
        const auto i = static_cast<std::size_t>(4 * (y * width_px + x) + c);
        most = std::max(most, std::abs(a.at(i) - b.at(i)));
      }
      if (most > grey) pixels.emplace_back(x, y);
    }
  return pixels;
}

// The depth cue: a needle's shadow meets its tip where it touches, and is as far away as light says where it does
// not. The needle is upright and is seen above its tip; its shadow falls towards the eye.
TEST_F(RoomPictures, TheShadowMeetsTheTipWhereTheNeedleTouches) {
  scene.instrument.radius_mm = 0.83;
  const RoomModel room = make_room_model(scene);
  RoomRenderer renderer(context, room);
  asked.width_px = asked.height_px = 500;
  const RoomFrame& f = room.frame;
  asked.camera.target_lps_mm = f.up * kBallMm;
  asked.camera.eye_lps_mm = asked.camera.target_lps_mm - 100.0 * f.across - 560.0 * f.head + 420.0 * f.up;
  asked.camera.up = f.up;
  asked.camera.height_deg = 16.0;
  const RoomProjection projection = projection_of(asked.camera, 0, 1.0);
  for (const RoomQuality& quality : {kFastRoom, RoomQuality{}}) {
    asked.quality = quality;
    for (const double height_mm : {0.0, 20.0}) {
      SCOPED_TRACE(std::to_string(quality.samples) + " samples, " + std::to_string(height_mm) + " mm above");
      const glm::dvec3 tip = f.up * (kBallMm + height_mm);
      state.needle.tip_lps_mm = tip;
      state.needle.direction = -f.up;
      options.probe = false;
      options.needle = false;
      const auto without = draw(renderer, room);
      options.needle = true;
      const auto with = draw(renderer, room);
      // Where the light past the tip meets the ball.
      const glm::dvec3 light = renderer.key_light();
      const double b = glm::dot(tip, light), c = glm::dot(tip, tip) - kBallMm * kBallMm;
      const glm::dvec3 shadow = tip - light * (b - std::sqrt(std::max(0.0, b * b - c)));
      const glm::dvec2 shadow_px = *pixel_of(projection, shadow, asked.width_px, asked.height_px);
      const glm::dvec2 tip_px = *pixel_of(projection, tip, asked.width_px, asked.height_px);
      double nearest_px = 1e9, expected_px = glm::distance(shadow_px, tip_px), at_shadow_px = 1e9;
      for (const glm::ivec2& pixel : changed(with, without, asked.width_px, 0, asked.width_px, 20)) {
        const glm::dvec2 middle = glm::dvec2(pixel) + 0.5;
        if (middle.y < tip_px.y + 2.0) continue;  // the needle itself
        nearest_px = std::min(nearest_px, glm::distance(middle, tip_px));
        at_shadow_px = std::min(at_shadow_px, glm::distance(middle, shadow_px));
      }
      EXPECT_LT(at_shadow_px, 4.0);
      EXPECT_NEAR(nearest_px, expected_px, 5.0);
      if (height_mm > 0.0) {
        EXPECT_GT(expected_px, 25.0);
      }
    }
  }
}

// Where light past the middle of the detector's face meets the ball it is dark, also where the detector is nearer
// to the lamp than the map about the patient; and the map is drawn again only while the arm moves.
TEST_F(RoomPictures, ADetectorCastsItsShadowWhereverTheArmStands) {
  scene = ball_case(cases::Modality::xray);
  options.needle = false;
  state.fluoroscopy.in_use = true;
  const RoomModel room = make_room_model(scene);
  RoomRenderer renderer(context, room);
  asked.width_px = asked.height_px = 300;
  asked.quality = kFastRoom;
  asked.quality.still_shadow_age = 0;
  const glm::dvec3 light = renderer.key_light();
  asked.camera.target_lps_mm = {0.0, 0.0, 0.0};
  asked.camera.up = room.frame.up;
  int draws = 0;
  for (const double sid_mm : {1000.0, 1150.0}) {
    SCOPED_TRACE(sid_mm);
    state.fluoroscopy.arm.sid_mm = sid_mm;
    // So that light past the detector comes to the ball.
    const double above_mm = sid_mm - scene.fluoroscope.source_isocentre_mm;
    state.fluoroscopy.arm.isocentre_lps_mm = above_mm * (light / glm::dot(light, room.frame.up) - room.frame.up);
    // A corner of the detector's face in whose shadow the ball lies.
    make_draw_list(room, scene, state, options, list);
    const auto detector = std::find_if(list.items.begin(), list.items.end(),
                                       [](const RoomItem& item) { return item.part == RoomPart::detector; });
    ASSERT_NE(detector, list.items.end());
    EXPECT_EQ(detector->casts, Casts::still);
    double dark_mm = 1e9;
    glm::dvec3 shadow(0.0);
    const double half_mm = 0.5 * scene.fluoroscope.detector_side_mm;
    for (int i = -4; i <= 4; ++i)
      for (int j = -4; j <= 4; ++j) {
        const glm::dvec3 edge(detector->lps_from_mesh * glm::dvec4(0.2 * half_mm * i, 0.2 * half_mm * j, 0.0, 1.0));
        const double b = glm::dot(edge, light), c = glm::dot(edge, edge) - kBallMm * kBallMm;
        if (b * b - c <= 0.0) continue;
        const glm::dvec3 at = edge - light * (b - std::sqrt(b * b - c));
        const double off_mm = glm::distance(at, kBallMm * glm::normalize(room.frame.up - 0.4 * room.frame.head));
        if (off_mm < dark_mm) shadow = at;
        dark_mm = std::min(dark_mm, off_mm);
      }
    ASSERT_LT(dark_mm, 100.0);
    // From where the shadow is, and the detector is not between.
    asked.camera.eye_lps_mm = 6.0 * shadow - 500.0 * room.frame.head;
    const auto with = draw(renderer, room);
    EXPECT_EQ(renderer.still_shadow_draws(), ++draws);
    static_cast<void>(draw(renderer, room));
    EXPECT_EQ(renderer.still_shadow_draws(), draws) << "it stands";
    for (RoomItem& item : list.items)
      if (item.part == RoomPart::detector || item.part == RoomPart::tube) item.casts = Casts::nothing;
    RoomRenderer other(context, room);
    other.draw(list, asked);
    const auto without = other.read_rgba();
    const RoomProjection projection = projection_of(asked.camera, 0, 1.0);
    const glm::dvec2 px = *pixel_of(projection, shadow, asked.width_px, asked.height_px);
    const Rgb dark = at(with, static_cast<int>(px.x), static_cast<int>(px.y));
    const Rgb lit = at(without, static_cast<int>(px.x), static_cast<int>(px.y));
    EXPECT_TRUE(is_skin(lit));
    EXPECT_LT(3 * dark.r, 2 * lit.r) << dark.r << " of " << lit.r;
  }
}

TEST_F(RoomPictures, APairIsApartAsTheTwoEyesSee) {
  scene.planned_entry_lps_mm = glm::dvec3(20.0, -kBallMm, 30.0);
  const RoomModel room = make_room_model(scene);
  RoomRenderer renderer(context, room);
  asked.width_px = 800;
  asked.height_px = 400;
  asked.views = 2;
  asked.quality = kFastRoom;
  for (const double nearer_mm : {150.0, 0.0, -150.0}) {
    asked.camera = room_camera(room, scene, state, RoomView::top);
    asked.camera.target_lps_mm =
        *scene.planned_entry_lps_mm - glm::dvec3(20.0, 0.0, 30.0) - room.frame.up * nearer_mm;
    asked.camera.eye_lps_mm = asked.camera.target_lps_mm + room.frame.up * 800.0;
    options.needle = options.probe = false;
    options.help = 0;
    const auto without = draw(renderer, room);
    options.help = 2;  // the planned entry alone: no tools are held
    const auto with = draw(renderer, room);
    double x[2] = {0.0, 0.0};
    for (int eye = 0; eye < 2; ++eye) {
      const auto pixels = changed(with, without, asked.width_px, 400 * eye, 400 * (eye + 1), 8);
      ASSERT_FALSE(pixels.empty());
      for (const glm::ivec2& pixel : pixels)
        x[eye] += (pixel.x + 0.5 - 400.0 * eye) / static_cast<double>(pixels.size());
      const auto expected =
          pixel_of(projection_of(asked.camera, 2 * eye - 1, 1.0), *scene.planned_entry_lps_mm, 400, 400);
      EXPECT_NEAR(x[eye], expected->x, 0.8) << nearer_mm;
    }
    if (nearer_mm > 0.0) {
      EXPECT_LT(x[1], x[0] - 5.0);  // nearer than the screen: crossed
    } else if (nearer_mm < 0.0) {
      EXPECT_GT(x[1], x[0] + 3.0);
    } else {
      EXPECT_NEAR(x[1], x[0], 0.8);
    }
  }
}

TEST_F(RoomPictures, SkinThatIsPressedIsDrawnWhereItIs) {
  scene.yields = true;
  const RoomModel room = make_room_model(scene);
  RoomRenderer renderer(context, room);
  asked.width_px = asked.height_px = 300;
  asked.quality = kFastRoom;
  asked.camera.target_lps_mm = {0.0, -kBallMm, 0.0};
  asked.camera.eye_lps_mm = {0.0, -kBallMm, -700.0};
  asked.camera.up = {0.0, -1.0, 0.0};
  asked.camera.height_deg = 12.0;
  options.needle = options.probe = false;
  const tissue::SkinPress press{{0.0, -kBallMm, 0.0}, {0.0, 1.0, 0.0}, 40.0, 12.0, 0.0};
  const tissue::Displacement displacement = tissue::displacement_of({{&press, 1}, {}, {}, {}});
  make_draw_list(room, scene, state, options, list);
  // Height of the outline over a place at rest, mm below the ball's top.
  const auto outline_mm = [&](const tissue::Displacement& by, double across_mm) {
    renderer.draw(list, asked, by);
    const auto rgba = renderer.read_rgba();
    const RoomProjection p = projection_of(asked.camera, 0, 1.0);
    for (double down = -10.0; down < 40.0; down += 0.25) {
      const auto pixel = *pixel_of(p, {across_mm, -kBallMm + down, 0.0}, 300, 300);
      if (is_skin(at(rgba, static_cast<int>(pixel.x), static_cast<int>(pixel.y)))) return down;
    }
    return 1e9;
  };
  for (const double across_mm : {0.0, 30.0, -45.0}) {
    const double rest = kBallMm - std::sqrt(kBallMm * kBallMm - across_mm * across_mm);
    EXPECT_NEAR(outline_mm({}, across_mm), rest, 1.2);
    // Looking along z, the outline is the highest of what lies behind one another: at a dent's middle that is its
    // rim, where the ball itself has fallen away by as much.
    double expected = 1e9;
    for (double z = -100.0; z <= 100.0; z += 1.0)
      for (double x = across_mm - 6.0; x <= across_mm + 6.0; x += 0.25) {
        const double y_2 = kBallMm * kBallMm - x * x - z * z;
        if (y_2 <= 0.0) continue;
        const glm::dvec3 moved = tissue::displaced(displacement, {x, -std::sqrt(y_2), z});
        if (std::abs(moved.x - across_mm) < 0.3) expected = std::min(expected, moved.y + kBallMm);
      }
    EXPECT_NEAR(outline_mm(displacement, across_mm), expected, 1.5) << across_mm;
  }
  EXPECT_GT(outline_mm(displacement, 0.0), 3.0);
}

TEST_F(RoomPictures, AStillPatientCostsNoDisplacementAndNoNewShadowMap) {
  const RoomModel room = make_room_model(scene);
  RoomRenderer renderer(context, room);
  asked.width_px = asked.height_px = 64;
  asked.camera = room_camera(room, scene, state, RoomView::operator_side);
  const tissue::SkinPress press{{0.0, -kBallMm, 0.0}, {0.0, 1.0, 0.0}, 40.0, 12.0, 0.0};
  const tissue::Displacement pressed = tissue::displacement_of({{&press, 1}, {}, {}, {}});
  make_draw_list(room, scene, state, options, list);
  for (int i = 0; i < 5; ++i) renderer.draw(list, asked, pressed);  // the case lies still: nothing asks for it
  EXPECT_EQ(renderer.displacement_uploads(), 0);
  EXPECT_EQ(renderer.still_shadow_draws(), 1);
  scene.yields = true;
  make_draw_list(room, scene, state, options, list);
  for (int i = 0; i < 3; ++i) renderer.draw(list, asked, tissue::Displacement{});  // not touched yet
  EXPECT_EQ(renderer.displacement_uploads(), 0);
  EXPECT_EQ(renderer.still_shadow_draws(), 1);
  renderer.draw(list, asked, pressed);
  EXPECT_EQ(renderer.displacement_uploads(), 1);
  EXPECT_EQ(renderer.still_shadow_draws(), 2);
  renderer.draw(list, asked, tissue::Displacement{});  // let go: shadows as at rest, once more
  renderer.draw(list, asked, tissue::Displacement{});
  EXPECT_EQ(renderer.still_shadow_draws(), 3);
}

TEST_F(RoomPictures, ShadowsOfWhatLiesStillMayBeALittleOldWhileTissueMoves) {
  const RoomModel room = make_room_model(scene);
  asked.width_px = asked.height_px = 64;
  asked.camera = room_camera(room, scene, state, RoomView::operator_side);
  scene.yields = true;
  make_draw_list(room, scene, state, options, list);
  const auto pressed = [](int by_mm) {
    const tissue::SkinPress press{{0.0, -kBallMm, 0.0}, {0.0, 1.0, 0.0}, 40.0, 1.0 * by_mm, 0.0};
    return tissue::displacement_of({{&press, 1}, {}, {}, {}});
  };
  for (const int age : {0, 3}) {
    RoomRenderer renderer(context, room);
    asked.quality.still_shadow_age = age;
    for (int i = 0; i < 9; ++i) renderer.draw(list, asked, pressed(1 + i));
    EXPECT_EQ(renderer.still_shadow_draws(), age == 0 ? 9 : 3) << "pictures 0, 4 and 8";
    for (int i = 0; i < 9; ++i) renderer.draw(list, asked, pressed(9));
    EXPECT_EQ(renderer.still_shadow_draws(), age == 0 ? 9 : 3) << "nothing changed any more";
    renderer.draw(list, asked, tissue::Displacement{});
    EXPECT_EQ(renderer.still_shadow_draws(), age == 0 ? 10 : 4) << "let go: at once";
  }
}

TEST_F(RoomPictures, EverySettingDrawsAllOfIt) {
  scene.structures.push_back({"organ", {}, cases::StructureRule::organ, cases::Sphere{{0, 0, 0}, 30.0}});
  for (const auto modality : {cases::Modality::ultrasound, cases::Modality::xray, cases::Modality::mpr}) {
    scene.picture.modality = modality;
    const RoomModel room = make_room_model(scene, {5'000, true});
    RoomRenderer renderer(context, room);
    asked.width_px = 120;
    asked.height_px = 90;
    options.help = 3;
    for (const bool mentor : {false, true})
      for (const int views : {1, 2})
        for (const RoomQuality& quality : {kFastRoom, RoomQuality{}}) {
          options.mentor = mentor;
          asked.views = views;
          asked.quality = quality;
          asked.camera = room_camera(room, scene, state, RoomView::operator_side);
          const auto rgba = draw(renderer, room);  // throws on any GL error
          int opaque = 0;
          for (std::size_t i = 3; i < rgba.size(); i += 4) opaque += rgba[i] == 255 ? 1 : 0;
          EXPECT_EQ(opaque, 120 * 90);
        }
  }
}

TEST_F(RoomPictures, AreTheSameTwice) {
  const RoomModel room = make_room_model(scene);
  RoomRenderer renderer(context, room);
  asked.width_px = 200;
  asked.height_px = 150;
  asked.camera = room_camera(room, scene, state, RoomView::operator_side);
  const auto first = draw(renderer, room);
  EXPECT_EQ(draw(renderer, room), first);
  RoomRenderer other(context, room);
  EXPECT_EQ(draw(other, room), first);
}

}  // namespace
}  // namespace seldinger::imaging
