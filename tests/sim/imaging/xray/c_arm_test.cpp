// Tests of sim/imaging/xray/c_arm: the geometry that projections get, and the hand in the beam.
#include "sim/imaging/xray/c_arm.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "sim/base/rng.h"

namespace seldinger::imaging {
namespace {

cases::CArm arm_at(double lao_deg, double cranial_deg) {
  cases::CArm arm;
  arm.lao_deg = lao_deg;
  arm.cranial_deg = cranial_deg;
  arm.isocentre_lps_mm = {7, -8, 9};
  return arm;
}

TEST(CArmGeometry, IsSoundAndItsPixelsLieWhereShadowsFall) {
  const cases::Fluoroscope machine;
  base::Rng rng(1);
  for (int i = 0; i < 50; ++i)
    for (const auto position : {cases::PatientPosition::supine, cases::PatientPosition::prone}) {
      const cases::CArm arm = arm_at(-100 + 200 * rng.uniform(), -45 + 90 * rng.uniform());
      const int magnification = i % 3;
      const XrayGeometry geometry = c_arm_geometry(machine, arm, magnification, 64, position);
      ASSERT_TRUE(check_geometry(geometry).has_value());
      EXPECT_EQ(geometry.width_px, 64);
      EXPECT_NEAR(geometry.pixel_mm * 64, machine.field_side_mm[static_cast<std::size_t>(magnification)], 1e-9);
      // A pixel's centre is its own shadow, at its place on the detector.
      const int column = static_cast<int>(rng.uniform() * 64), row = static_cast<int>(rng.uniform() * 64);
      const glm::dvec3 center = geometry.detector_center_lps_mm +
                                geometry.u * (geometry.pixel_mm * (column - 31.5)) +
                                geometry.v * (geometry.pixel_mm * (row - 31.5));
      const auto shadow = cases::shadow_of(cases::beam_frame(machine, arm, position), center);
      ASSERT_TRUE(shadow.has_value());
      EXPECT_NEAR(shadow->detector_mm.x, geometry.pixel_mm * (column - 31.5), 1e-9);
      EXPECT_NEAR(shadow->detector_mm.y, geometry.pixel_mm * (row - 31.5), 1e-9);
      EXPECT_NEAR(shadow->magnification, 1.0, 1e-12);
    }
}

// A beam along −y from the origin's far side: source at y = 785 behind the isocentre at 0, detector at y = −315.
cases::BeamFrame straight() {
  return cases::beam_frame(cases::Fluoroscope{}, cases::CArm{}, cases::PatientPosition::supine);
}

TEST(MeetsBeam, BesideAFlankTheDistanceIsTheClosedForm) {
  // Field 300 mm at 1100 mm, half open: half side 75 mm. The flank rises 75 in 1100; a point beside it at depth z
  // and x from the axis is (x·1100 − 75·z)/√(1100² + 75²) away.
  const cases::Collimator half{0.5, 0.5};
  const double z = 785.0, slope = std::sqrt(1100.0 * 1100.0 + 75.0 * 75.0);
  const double x = 75.0 * z / 1100.0 + 45.0 * slope / 1100.0;  // exactly 45 mm away
  for (const double sign : {-1.0, 1.0}) {
    EXPECT_TRUE(meets_beam(straight(), 300.0, half, {sign * (x - 1e-6), 0, 0}, 45.0));
    EXPECT_FALSE(meets_beam(straight(), 300.0, half, {sign * (x + 1e-6), 0, 0}, 45.0));
    EXPECT_TRUE(meets_beam(straight(), 300.0, half, {0, 0, sign * (x - 1e-6)}, 45.0));
    EXPECT_FALSE(meets_beam(straight(), 300.0, half, {0, 0, sign * (x + 1e-6)}, 45.0));
  }
}

TEST(MeetsBeam, InsideBehindAndBeyond) {
  const cases::Collimator open;
  EXPECT_TRUE(meets_beam(straight(), 300.0, open, {0, 0, 0}, 1.0));
  EXPECT_TRUE(meets_beam(straight(), 300.0, open, {0, 785.0 + 44.0, 0}, 45.0)) << "it reaches to the source";
  EXPECT_FALSE(meets_beam(straight(), 300.0, open, {0, 785.0 + 46.0, 0}, 45.0));
  EXPECT_TRUE(meets_beam(straight(), 300.0, open, {100, -315.0 - 44.9, 0}, 45.0));
  EXPECT_FALSE(meets_beam(straight(), 300.0, open, {100, -315.0 - 45.1, 0}, 45.0)) << "the detector ends the beam";
  // Beyond the detector's corner: 3-4-12 box, 13 mm away.
  EXPECT_TRUE(meets_beam(straight(), 300.0, open, {153, -315.0 - 12.0, 154}, 13.0 + 1e-6));
  EXPECT_FALSE(meets_beam(straight(), 300.0, open, {153, -315.0 - 12.0, 154}, 13.0 - 1e-6));
}

TEST(MeetsBeam, AgreesWithSamplingTheBeam) {
  base::Rng rng(2);
  int met = 0;
  for (int i = 0; i < 200; ++i) {
    const cases::Collimator blades{0.1 + 0.9 * rng.uniform(), 0.1 + 0.9 * rng.uniform()};
    const cases::BeamFrame frame =
        cases::beam_frame(cases::Fluoroscope{}, arm_at(-90 + 180 * rng.uniform(), -40 + 80 * rng.uniform()),
                          cases::PatientPosition::supine);
    const glm::dvec3 center = frame.source_lps_mm + frame.direction * (1200.0 * rng.uniform() - 50.0) +
                              frame.u * (rng.normal() * 120.0) + frame.v * (rng.normal() * 120.0);
    double nearest = 1e9;
    for (int s = 0; s <= 110; ++s)
      for (int a = -20; a <= 20; ++a)
        for (int b = -20; b <= 20; ++b) {
          const double t = s / 110.0;
          const glm::dvec3 p = frame.source_lps_mm + frame.direction * (t * frame.sid_mm) +
                               frame.u * (t * 150.0 * blades.open_u * a / 20.0) +
                               frame.v * (t * 150.0 * blades.open_v * b / 20.0);
          nearest = std::min(nearest, glm::length(p - center));
        }
    constexpr double kLattice = 9.0;  // no point of the beam is farther from the lattice
    const bool meets = meets_beam(frame, 300.0, blades, center, kHandRadiusMm);
    if (nearest <= kHandRadiusMm) {
      EXPECT_TRUE(meets) << i << ": " << nearest;
    }
    if (nearest > kHandRadiusMm + kLattice) {
      EXPECT_FALSE(meets) << i << ": " << nearest;
    }
    met += meets ? 1 : 0;
  }
  EXPECT_GT(met, 40);
  EXPECT_LT(met, 160);
}

TEST(HandAtNeedle, IsNearTheHub) {
  const glm::dvec3 hand = hand_at_needle({1, 2, 3}, {0, 1, 0}, 200.0);
  EXPECT_NEAR(glm::length(hand - glm::dvec3(1, -118, 3)), 0.0, 1e-12);
}

}  // namespace
}  // namespace seldinger::imaging
