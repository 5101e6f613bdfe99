// Needle and lesions against their closed forms.
#include "sim/imaging/xray/instruments.h"

#include <limits>

#include "sim/volume/analytic.h"
#include "tests/sim/imaging/xray/xray_scene.h"

namespace seldinger::imaging {
namespace {

constexpr double kRadiusMm = 0.635, kInnerMm = 0.42;  // 18 gauge

NeedlePose needle_along(const glm::dvec3& direction, const glm::dvec3& tip = glm::dvec3(0.0)) {
  return {tip, glm::normalize(direction), 200.0, kRadiusMm, 0.0, 3000.0};
}

TEST(XrayInstruments, CylinderChordIsTheClosedForm) {
  const glm::dvec3 direction = glm::normalize(glm::dvec3(0.2, -0.3, 0.9));
  const glm::dvec3 tip(5.0, 3.0, -2.0);
  for (std::uint64_t i = 0; i < 2000; ++i) {
    const auto u = [&](std::uint64_t k) { return 2.0 * base::uniform_at(31, 6 * i + k) - 1.0; };
    // Aimed at a point near the axis, 50 mm up the shaft, from a source 1 m away.
    const glm::dvec3 aim = tip - 50.0 * direction + 0.8 * glm::dvec3(u(0), u(1), u(2));
    const glm::dvec3 from = aim + 1000.0 * glm::normalize(glm::dvec3(u(3), u(4), u(5)));
    const RaySegment ray{from, 2.0 * aim - from};
    // Closed form: the distance between the lines, and the sine of their angle.
    const glm::dvec3 along = glm::normalize(ray.to_lps_mm - ray.from_lps_mm);
    const glm::dvec3 across = glm::cross(along, direction);
    const double sine = glm::length(across);
    if (sine < 0.2) continue;  // end-on: the flat ends come in
    const double distance = std::abs(glm::dot(from - tip, across)) / sine;
    const double chord_mm = 2.0 * std::sqrt(std::max(0.0, kRadiusMm * kRadiusMm - distance * distance)) / sine;
    const Chord chord = cylinder_chord(ray, tip, direction, 200.0, kRadiusMm);
    const double length_mm = std::max(0.0, chord.leave - chord.enter) * glm::length(ray.to_lps_mm - from);
    ASSERT_NEAR(length_mm, chord_mm, 1e-6) << i;
  }
}

TEST(XrayInstruments, EndOnTheNeedleIsItsLength) {
  const RaySegment ray{{0.1, 0.2, -700.0}, {0.1, 0.2, 300.0}};
  const Chord chord = cylinder_chord(ray, {0, 0, 10}, {0, 0, 1}, 120.0, kRadiusMm);
  EXPECT_NEAR((chord.leave - chord.enter) * 1000.0, 120.0, 1e-9);
  const RaySegment beside{{0.7, 0.2, -700.0}, {0.7, 0.2, 300.0}};
  const Chord none = cylinder_chord(beside, {0, 0, 10}, {0, 0, 1}, 120.0, kRadiusMm);
  EXPECT_GE(none.enter, none.leave);
  // Across, beyond the tip.
  const RaySegment beyond{{-500.0, 0.0, 10.01}, {500.0, 0.0, 10.01}};
  const Chord past = cylinder_chord(beyond, {0, 0, 10}, {0, 0, 1}, 120.0, kRadiusMm);
  EXPECT_GE(past.enter, past.leave);
}

TEST(XrayInstruments, SphereChordIsTheClosedForm) {
  for (double miss = 0.0; miss < 9.0; miss += 0.37) {
    const RaySegment ray{{-800.0, 2.0 + miss, 1.0}, {700.0, 2.0 + miss, 1.0}};
    const Chord chord = sphere_chord(ray, {3.0, 2.0, 1.0}, 8.0);
    const double expected = 2.0 * std::sqrt(std::max(0.0, 64.0 - miss * miss));
    EXPECT_NEAR(std::max(0.0, chord.leave - chord.enter) * 1500.0, expected, 1e-9);
  }
}

TEST(XrayInstruments, NeedleDisplacesTissueAndItsLumenIsEmpty) {
  const volume::Volume water = centered({60, 60, 60}, {1, 1, 1}, 0);
  const RaySegment ray{{-500, 0, 0}, {500, 0, 0}};
  Inserted inserted;
  inserted.needle = needle_along({0, 0, 1}, {0, 0, 20});
  const OverlaidLengths solid = overlaid_lengths(water, ray, inserted, ProjectionMethod::exact);
  EXPECT_NEAR(solid.iron_mm, 2.0 * kRadiusMm, 1e-9);
  EXPECT_NEAR(solid.water_mm, -2.0 * kRadiusMm, 1e-9);
  inserted.needle->inner_radius_mm = kInnerMm;
  const OverlaidLengths hollow = overlaid_lengths(water, ray, inserted, ProjectionMethod::exact);
  EXPECT_NEAR(hollow.iron_mm, 2.0 * (kRadiusMm - kInnerMm), 1e-9);
  EXPECT_NEAR(hollow.water_mm, -2.0 * kRadiusMm, 1e-9);
}

TEST(XrayInstruments, NeedleOverLesionOverVolumeAndTheFirstLesionWins) {
  const volume::Volume bone = centered({60, 60, 60}, {1, 1, 1}, 500);  // 1 water and 0.5 mineral per mm
  const RaySegment ray{{-500, 0, 0}, {500, 0, 0}};
  Inserted inserted;
  inserted.lesions = {{{0, 0, 0}, 5.0, 100.0}, {{6, 0, 0}, 5.0, -200.0}};
  // First 10 mm at 100 HU; of the second the 6 mm that are not the first's, at −200 HU.
  const OverlaidLengths lesions = overlaid_lengths(bone, ray, inserted, ProjectionMethod::exact);
  EXPECT_NEAR(lesions.water_mm, 10.0 * 1.0 + 6.0 * 0.8 - 16.0, 1e-9);
  EXPECT_NEAR(lesions.mineral_mm, 10.0 * 0.1 - 16.0 * 0.5, 1e-9);
  inserted.needle = needle_along({0, 0, 1}, {2.0, 0, 20});
  const OverlaidLengths both = overlaid_lengths(bone, ray, inserted, ProjectionMethod::exact);
  const double d = 2.0 * kRadiusMm;
  EXPECT_NEAR(both.iron_mm, d, 1e-9);
  EXPECT_NEAR(both.water_mm, lesions.water_mm - d * 1.0, 1e-9);
  EXPECT_NEAR(both.mineral_mm, lesions.mineral_mm - d * 0.1, 1e-9);
}

// Every pixel of an instrument's shadow is laid over, and no other: each pixel against its own ray.
TEST(XrayInstruments, TheWholeShadowIsLaidOver) {
  const volume::Volume water = centered({80, 80, 80}, {1, 1, 1}, 0);
  Inserted inserted;
  inserted.needle = needle_along({0.5, 0.8, -0.4}, {3, -4, 5});
  inserted.lesions = {{{10, 5, -8}, 7.0, 60.0}};
  for (const glm::dvec3& axis : {glm::dvec3(0, 1, 0), glm::dvec3(0.5, 0.8, -0.4), glm::dvec3(1, 0.2, 0.3)})
    for (const bool point : {true, false}) {
      const XrayGeometry g = point ? facing(axis, 300.0, 150) : parallel(axis, 300.0, 150);
      const PathLengths plain = XrayCpu(water).project(g, ProjectionMethod::exact);
      PathLengths laid = plain;
      overlay_instruments(water, g, inserted, ProjectionMethod::exact, laid);
      int with_iron = 0;
      for (int row = 0; row < 150; ++row)
        for (int column = 0; column < 150; ++column) {
          const auto i = static_cast<std::size_t>(row * 150 + column);
          const OverlaidLengths expected =
              overlaid_lengths(water, ray_of(g, water, column, row), inserted, ProjectionMethod::exact);
          ASSERT_NEAR(static_cast<double>(laid.iron_mm[i]), expected.iron_mm, 1e-4) << column << ' ' << row;
          ASSERT_NEAR(static_cast<double>(laid.water_mm[i]),
                      std::max(0.0, static_cast<double>(plain.water_mm[i]) + expected.water_mm), 1e-4);
          with_iron += laid.iron_mm[i] > 0.0F ? 1 : 0;
        }
      const bool end_on = axis.x == 0.5;  // a needle thinner than a pixel may fall between the rays
      EXPECT_GT(with_iron, end_on ? -1 : 20);
    }
}

// A sphere drawn by its chord is the sphere drawn in voxels, as voxels get small.
TEST(XrayInstruments, ALesionLooksLikeItsVoxels) {
  volume::AnalyticVolume analytic;
  analytic.size_voxels = {120, 120, 120};
  analytic.spacing_mm = glm::dvec3(0.5);
  analytic.origin_mm = glm::dvec3(-29.75);
  analytic.background_hu = 0.0;
  const volume::Volume plain = volume::rasterize(analytic);
  analytic.shapes.push_back({volume::Sphere{{2, 3, -1}, 10.0}, 400.0});
  const volume::Volume with = volume::rasterize(analytic);
  const XrayGeometry g = facing({0.3, 1.0, 0.2}, 60.0, 64);
  PathLengths laid = XrayCpu(plain).project(g, ProjectionMethod::exact);
  Inserted inserted;
  inserted.lesions = {{{2, 3, -1}, 10.0, 400.0}};
  overlay_instruments(plain, g, inserted, ProjectionMethod::exact, laid);
  const PathLengths drawn = XrayCpu(with).project(g, ProjectionMethod::exact);
  double sum = 0.0;
  for (std::size_t i = 0; i < laid.water_mm.size(); ++i) {
    const double difference = total_mm(laid, i) - total_mm(drawn, i);
    sum += difference * difference;
  }
  EXPECT_LT(std::sqrt(sum / 4096.0), 0.4 * 0.5);  // within a voxel's worth of the 0.4 above water
}

TEST(XrayInstruments, ALostNeedleIsNotShown) {
  const volume::Volume water = centered({20, 20, 20}, {1, 1, 1}, 0);
  const XrayGeometry g = facing({0, 1, 0}, 40.0, 16);
  PathLengths lengths = XrayCpu(water).project(g, ProjectionMethod::exact);
  const PathLengths before = lengths;
  Inserted inserted;
  inserted.needle = needle_along({0, 0, 1});
  inserted.needle->tip_lps_mm.x = std::numeric_limits<double>::quiet_NaN();
  overlay_instruments(water, g, inserted, ProjectionMethod::exact, lengths);
  EXPECT_EQ(lengths.water_mm, before.water_mm);
  EXPECT_TRUE(lengths.iron_mm.empty());
}

}  // namespace
}  // namespace seldinger::imaging
