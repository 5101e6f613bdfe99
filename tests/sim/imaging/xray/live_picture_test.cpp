// The picture on the screen: what is integrated again and what is not, and that shortcuts stay near the exact
// picture.
#include "sim/imaging/xray/live_picture.h"

#include "sim/imaging/xray/projection/coarse.h"
#include "tests/sim/imaging/xray/xray_scene.h"

namespace seldinger::imaging {
namespace {

struct Room {
  volume::Volume volume = noisy({60, 60, 60}, {3, 3, 3}, -50, 80);
  XrayCpu projector{volume};
  cases::Fluoroscope machine;
  Beams beams{machine};
  LivePicture live{volume, projector};
  XrayGeometry geometry = facing({0, 1, 0}, 300.0, 64);
  Pulse pulse;
  PictureSettings settings;
  Inserted inserted;

  const FluoroscopyPicture& expose(bool moves) {
    ++settings.frame;
    return live.expose(geometry, moves, inserted, {}, beams.at(pulse.technique.kv), beams.detector(), 300.0, pulse,
                       settings);
  }
};

TEST(LivePicture, IntegratesAgainOnlyWhenTheGeometryChanges) {
  Room room;
  EXPECT_EQ(room.live.held(), nullptr);
  room.expose(false);
  EXPECT_EQ(room.live.integrations(), 1);
  room.pulse.technique = {85.0, 12.0, 8.0};
  room.pulse.collimator.open_u = 0.5;
  room.settings.window = LogWindow{-4.0, 3.0};
  room.inserted.needle = NeedlePose{{0, 0, 0}, {0, 0, 1}, 100.0, 0.6, 0.0, 3000.0};
  room.expose(false);
  room.inserted.needle->tip_lps_mm.x = 20.0;
  room.expose(false);
  EXPECT_EQ(room.live.integrations(), 1);
  room.geometry.source_lps_mm->x += 1.0;
  room.expose(false);
  EXPECT_EQ(room.live.integrations(), 2);
}

TEST(LivePicture, MovesCoarselyAndIsExactAtRest) {
  Room room;
  room.settings.noise = false;
  room.expose(true);
  EXPECT_EQ(room.live.integrations(), 1);
  room.expose(true);
  EXPECT_EQ(room.live.integrations(), 1) << "the same place needs nothing new";
  const std::vector<float> moving = room.live.held()->log_signal;
  const std::vector<float> rest = room.expose(false).log_signal;
  EXPECT_EQ(room.live.integrations(), 2);
  FluoroscopyPicture exact;
  render_picture(room.beams.at(room.pulse.technique.kv), room.beams.detector(), 300.0, room.pulse,
                 room.projector.project(room.geometry, ProjectionMethod::exact), room.settings, exact);
  EXPECT_EQ(rest, exact.log_signal);
  double sum = 0.0;
  for (std::size_t i = 0; i < rest.size(); ++i) sum += std::abs(static_cast<double>(moving[i] - rest[i]));
  EXPECT_LT(sum / static_cast<double>(rest.size()), 0.1) << "mean difference in log signal";
  EXPECT_GT(sum, 0.0);
}

// The last image is held; a new pulse over the same lengths has new noise.
TEST(LivePicture, HoldsTheLastImage) {
  Room room;
  const std::vector<unsigned char> first = room.expose(false).grey;
  ASSERT_NE(room.live.held(), nullptr);
  EXPECT_EQ(room.live.held()->grey, first);
  EXPECT_NE(room.expose(false).grey, first);
}

TEST(Coarse, EnlargesALinearPictureExactlyAwayFromItsBorder) {
  PathLengths coarse{8, 6, {}, {}, {}};
  for (int row = 0; row < 6; ++row)
    for (int column = 0; column < 8; ++column) {
      coarse.water_mm.push_back(3.0F * static_cast<float>(column) + 5.0F * static_cast<float>(row));
      coarse.mineral_mm.push_back(1.0F);
    }
  const PathLengths fine = enlarged(coarse, 4);
  ASSERT_EQ(fine.width_px, 32);
  ASSERT_EQ(fine.height_px, 24);
  for (int row = 2; row < 22; ++row)
    for (int column = 2; column < 30; ++column)
      ASSERT_NEAR(static_cast<double>(fine.water_mm[static_cast<std::size_t>(row * 32 + column)]),
                  3.0 * ((column + 0.5) / 4.0 - 0.5) + 5.0 * ((row + 0.5) / 4.0 - 0.5), 1e-4);
  for (const float mineral : fine.mineral_mm) ASSERT_EQ(mineral, 1.0F);
  const XrayGeometry g = facing({0, 1, 0}, 300.0, 64);
  const XrayGeometry half = coarser(g, 2);
  EXPECT_EQ(half.width_px, 32);
  EXPECT_DOUBLE_EQ(half.pixel_mm * half.width_px, g.pixel_mm * g.width_px);
}

}  // namespace
}  // namespace seldinger::imaging
