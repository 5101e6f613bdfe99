// Tissue that moves under X-ray: against the oracle that asks each place on its own, where a ball is seen, what of
// the beam is filled, and what is kept.
#include "sim/imaging/xray/projection/moved_volume.h"

#include "sim/imaging/xray/live_picture.h"
#include "sim/volume/analytic.h"
#include "tests/sim/imaging/xray/xray_scene.h"

namespace seldinger::imaging {
namespace {

// A trunk of 320 × 220 × 240 mm about the origin, its dome in the middle, that breathes as deep as `level` says.
tissue::Displacement breath(double level) {
  tissue::Breath breath;
  breath.region.half_width_mm = 160.0;
  breath.amount_mm = level * glm::dvec3(2.0, 15.0, 16.0);
  return tissue::displacement_of({.breath = breath});
}

constexpr glm::dvec3 kStone(-60.0, 10.0, -20.0);

// Soft tissue, a spine of bone and a stone.
const volume::Volume& trunk() {
  static const volume::Volume kTrunk = [] {
    volume::AnalyticVolume shapes;
    shapes.spacing_mm = {1.25, 1.25, 2.5};
    shapes.size_voxels = {272, 192, 96};
    shapes.origin_mm = -0.5 * glm::dvec3(shapes.size_voxels - 1) * shapes.spacing_mm;
    shapes.shapes.push_back({volume::Ellipsoid{{0, 0, 0}, {155, 108, 400}}, 30.0, ""});
    shapes.shapes.push_back({volume::Ellipsoid{{0, 60, 0}, {22, 20, 400}}, 500.0, ""});
    shapes.shapes.push_back({volume::Ellipsoid{{-70, 0, -10}, {50, 60, 80}}, 120.0, ""});
    shapes.shapes.push_back({volume::Sphere{kStone, 6.0}, 2500.0, ""});
    return volume::rasterize(shapes);
  }();
  return kTrunk;
}

XrayGeometry beam(const glm::dvec3& axis, double side_mm = 300.0, int size_px = 128) {
  return facing(axis, side_mm, size_px);
}

TEST(DisplacedLengths, OfWhoLiesStillAreTheExactOnes) {
  const XrayGeometry g = beam({0.2, -1, 0.1});
  for (const auto& [column, row] : {std::pair{64, 64}, {30, 70}, {90, 20}, {50, 100}}) {
    const RaySegment ray = ray_of(g, trunk(), column, row);
    const RayLengths exact = lengths_between(trunk(), ray.from_lps_mm, ray.to_lps_mm);
    const RayLengths sampled = displaced_lengths_between(trunk(), {}, ray.from_lps_mm, ray.to_lps_mm, 0.02);
    EXPECT_GT(exact.total_mm(), 50.0);
    EXPECT_NEAR(sampled.water_mm, exact.water_mm, 0.1);
    EXPECT_NEAR(sampled.mineral_mm, exact.mineral_mm, 0.1);
  }
}

TEST(MovedVolume, ItsProjectionIsTheOracles) {
  const tissue::Displacement in = breath(1.0);
  for (const glm::dvec3& axis : {glm::dvec3(0, -1, 0), glm::dvec3(1, 0, 0), glm::dvec3(0.5, -0.8, 0.3)}) {
    const XrayGeometry g = beam(axis);
    MovedVolume moved(trunk());
    EXPECT_TRUE(moved.move(in, g));
    const PathLengths lengths = moved.projector().project(g, ProjectionMethod::exact);
    const PathLengths still = XrayCpu(trunk()).project(g, ProjectionMethod::exact);
    double highest_mm = 0.0, off_mm = 0.0, still_off_mm = 0.0;
    std::vector<double> errors_mm;
    for (int row = 2; row < g.height_px; row += 5)
      for (int column = 2; column < g.width_px; column += 5) {
        const RaySegment ray = ray_of(g, trunk(), column, row);
        const double truth_mm =
            displaced_lengths_between(trunk(), in, ray.from_lps_mm, ray.to_lps_mm, 0.5).total_mm();
        const auto pixel = static_cast<std::size_t>(row * g.width_px + column);
        errors_mm.push_back(std::abs(total_mm(lengths, pixel) - truth_mm));
        off_mm += errors_mm.back();
        still_off_mm += std::abs(total_mm(still, pixel) - truth_mm);
        highest_mm = std::max(highest_mm, truth_mm);
      }
    std::sort(errors_mm.begin(), errors_mm.end());
    const auto count = static_cast<double>(errors_mm.size());
    EXPECT_LE(off_mm / count, 0.005 * highest_mm);
    EXPECT_LE(errors_mm[errors_mm.size() * 9 / 10], 0.01 * highest_mm) << "all but edges";
    EXPECT_GE(still_off_mm, 5.0 * off_mm) << "who is shown at rest is wrong";
  }
}

TEST(MovedVolume, AStoneIsSeenWhereTissueTookIt) {
  const tissue::Displacement in = breath(1.0);
  const glm::dvec3 now = tissue::displaced(in, kStone);
  ASSERT_GT(glm::length(now - kStone), 5.0);
  volume::Volume stone = centered(trunk().size_voxels, trunk().spacing_mm, volume::kAirHu);
  for (std::size_t i = 0; i < stone.hu.size(); ++i)
    if (trunk().hu[i] > 1000) stone.hu[i] = trunk().hu[i];
  const XrayGeometry g = beam({0, -1, 0}, 300.0, 256);
  MovedVolume moved(stone);
  moved.move(in, g);
  const PathLengths lengths = moved.projector().project(g, ProjectionMethod::exact);
  glm::dvec2 sum(0.0);
  double weight = 0.0;
  for (int row = 0; row < g.height_px; ++row)
    for (int column = 0; column < g.width_px; ++column) {
      const double mm = total_mm(lengths, static_cast<std::size_t>(row * g.width_px + column));
      sum += mm * glm::dvec2(column, row);
      weight += mm;
    }
  ASSERT_GT(weight, 0.0);
  const auto seen = pixel_of(g, now), rest = pixel_of(g, kStone);
  EXPECT_LT(glm::length(sum / weight - *seen) * g.pixel_mm, 0.5);
  EXPECT_GT(glm::length(sum / weight - *rest) * g.pixel_mm, 4.0);
}

// Only the beam is filled, but all of it: a narrow field sees what a wide one does.
TEST(MovedVolume, ANarrowFieldSeesTheSame) {
  const tissue::Displacement in = breath(-0.7);
  for (const glm::dvec3& axis : {glm::dvec3(0, -1, 0), glm::dvec3(-1, 0.3, 0.4)}) {
    XrayGeometry wide = beam(axis, 800.0, 256), narrow = beam(axis, 100.0, 32);
    narrow.detector_center_lps_mm += 60.0 * narrow.u;
    wide.detector_center_lps_mm += 60.0 * wide.u;
    MovedVolume all(trunk()), part(trunk());
    all.move(in, wide);
    part.move(in, narrow);
    EXPECT_LT(part.volume().hu.size(), all.volume().hu.size());
    const PathLengths a = all.projector().project(wide, ProjectionMethod::exact);
    const PathLengths b = part.projector().project(narrow, ProjectionMethod::exact);
    for (int row = 0; row < 32; ++row)
      for (int column = 0; column < 32; ++column) {
        // The grids of nodes begin elsewhere.
        const auto of_wide = static_cast<std::size_t>((row + 112) * 256 + column + 112);
        ASSERT_NEAR(total_mm(b, static_cast<std::size_t>(row * 32 + column)), total_mm(a, of_wide), 2.0)
            << column << ", " << row;
      }
  }
}

TEST(MovedVolume, IsKeptWhileNothingChanges) {
  const XrayGeometry g = beam({0, -1, 0});
  MovedVolume moved(trunk());
  EXPECT_TRUE(moved.move(breath(0.5), g));
  const std::vector<std::int16_t> first = moved.volume().hu;
  EXPECT_FALSE(moved.move(breath(0.5), g));
  XrayGeometry small = g;  // the same field in fewer pixels
  small.pixel_mm *= 2.0;
  small.width_px /= 2;
  small.height_px /= 2;
  EXPECT_FALSE(moved.move(breath(0.5), small));
  EXPECT_TRUE(moved.move(breath(0.6), g));
  EXPECT_NE(moved.volume().hu, first);
  EXPECT_TRUE(moved.move(breath(0.5), g));
  EXPECT_EQ(moved.volume().hu, first);
  EXPECT_TRUE(moved.move(breath(0.5), beam({1, 0, 0})));
}

TEST(MovedVolume, WithoutDisplacementAndJoiningIsTheVolume) {
  MovedVolume moved(trunk(), {0.1, 8.0});
  const XrayGeometry g = beam({0, -1, 0}, 2000.0);
  moved.move({}, g);
  const PathLengths a = moved.projector().project(g, ProjectionMethod::exact);
  const PathLengths b = XrayCpu(trunk()).project(g, ProjectionMethod::exact);
  EXPECT_LT(errors_of(a, b).max_nepers, 1e-5);
}

TEST(LivePicture, IntegratesWhoMovedAnew) {
  const XrayGeometry g = beam({0, -1, 0});
  const XrayCpu projector(trunk());
  LivePicture live(trunk(), projector);
  const cases::Fluoroscope machine;
  Beams beams(machine);
  const Pulse pulse;
  PictureSettings settings;
  settings.noise = false;
  const auto expose = [&] {
    return live.expose(g, false, {}, {}, beams.at(pulse.technique.kv), beams.detector(), 300.0, pulse, settings)
        .grey;
  };
  const auto still = expose();
  MovedVolume moved(trunk());
  moved.move(breath(1.0), g);
  live.take_patient(moved.volume(), moved.projector());
  const auto in = expose();
  EXPECT_NE(in, still);
  EXPECT_EQ(expose(), in);
  EXPECT_EQ(live.integrations(), 2);
  live.take_patient(trunk(), projector);
  EXPECT_EQ(expose(), still);
  EXPECT_EQ(live.integrations(), 3);
}

}  // namespace
}  // namespace seldinger::imaging
