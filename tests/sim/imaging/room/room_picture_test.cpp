// Pictures of the room, on whatever GL there is.
#include <gtest/gtest.h>

#include <cmath>

#include "sim/imaging/room/room_renderer.h"
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

  std::vector<std::uint8_t> draw(RoomRenderer& renderer, const RoomScene& room) {
    make_draw_list(room, scene, state, options, list);
    renderer.draw(list, asked);
    return renderer.read_rgba();
  }

  gpu::Context context;
  cases::Case scene = ball_case();
  cases::State state = ball_state();
  RoomOptions options;
  DrawList list;
  RoomPicture asked;
};

TEST_F(RoomPictures, TheSkinIsWhereItsOutlineIsProjected) {
  const RoomScene room = make_room_scene(scene);
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

TEST_F(RoomPictures, AreTheSameTwice) {
  const RoomScene room = make_room_scene(scene);
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
