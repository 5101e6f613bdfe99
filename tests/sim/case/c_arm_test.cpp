// Tests of sim/case/c_arm and sim/case/viewing_angles.
#include "sim/case/c_arm.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "sim/base/rng.h"
#include "sim/case/viewing_angles.h"

namespace seldinger::cases {
namespace {

using enum PatientPosition;

void expect_near(const glm::dvec3& a, const glm::dvec3& b, double tolerance) {
  for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(a[axis], b[axis], tolerance) << "axis " << axis;
}

CArm arm_at(double lao_deg, double cranial_deg, const glm::dvec3& isocentre_lps_mm = glm::dvec3(0.0)) {
  CArm arm;
  arm.lao_deg = lao_deg;
  arm.cranial_deg = cranial_deg;
  arm.isocentre_lps_mm = isocentre_lps_mm;
  return arm;
}

Shadow cast(const CArm& arm, PatientPosition position, const glm::dvec3& point_lps_mm) {
  const auto shadow = shadow_of(beam_frame(Fluoroscope{}, arm, position), point_lps_mm);
  EXPECT_TRUE(shadow.has_value());
  return shadow.value_or(Shadow{});
}

TEST(BeamDirection, OfTheNamedViews) {
  const double half = std::sqrt(0.5);
  expect_near(beam_direction(0, 0, supine), {0, -1, 0}, 1e-15);  // posterior to anterior
  expect_near(beam_direction(90, 0, supine), {1, 0, 0}, 1e-13);  // detector at the patient's left
  expect_near(beam_direction(-45, 0, supine), {-half, -half, 0}, 1e-13);
  expect_near(beam_direction(0, 45, supine), {0, -half, half}, 1e-13);  // detector towards the head
  expect_near(beam_direction(30, -20, supine), {0.4698463103929542, -0.8137976813493738, -0.3420201433256687},
              1e-13);
  expect_near(beam_direction(0, 0, prone), {0, 1, 0}, 1e-15);
  expect_near(beam_direction(90, 0, prone), {1, 0, 0}, 1e-13);         // still his left
  expect_near(beam_direction(0, 0, lateral_left), {-1, 0, 0}, 1e-15);  // his right side is up
  expect_near(beam_direction(90, 0, lateral_left), {0, -1, 0}, 1e-13);
  expect_near(beam_direction(0, 0, lateral_right), {1, 0, 0}, 1e-15);
  expect_near(beam_direction(90, 0, lateral_right), {0, 1, 0}, 1e-13);
}

TEST(BeamDirection, AnglesComeBack) {
  base::Rng rng(4);
  for (int i = 0; i < 1000; ++i)
    for (const PatientPosition position : {supine, prone, lateral_left, lateral_right}) {
      const double lao = -179.0 + 358.0 * rng.uniform(), cranial = -89.0 + 178.0 * rng.uniform();
      const BeamAngles back = angles_of_beam(beam_direction(lao, cranial, position), position);
      ASSERT_NEAR(back.lao_deg, lao, 1e-9);
      ASSERT_NEAR(back.cranial_deg, cranial, 1e-9);
    }
}

TEST(BeamFrame, IsOrthonormalAndTheIsocentreIsInTheMiddleAtAnyAngle) {
  base::Rng rng(5);
  for (int i = 0; i < 200; ++i)
    for (const PatientPosition position : {supine, prone, lateral_left, lateral_right}) {
      const glm::dvec3 isocentre(rng.normal() * 50, rng.normal() * 50, rng.normal() * 50);
      CArm arm = arm_at(-100 + 200 * rng.uniform(), -45 + 90 * rng.uniform(), isocentre);
      arm.sid_mm = 900 + 300 * rng.uniform();
      const BeamFrame frame = beam_frame(Fluoroscope{}, arm, position);
      ASSERT_NEAR(glm::length(frame.direction), 1.0, 1e-12);
      ASSERT_NEAR(glm::length(frame.u), 1.0, 1e-12);
      ASSERT_NEAR(glm::length(frame.v), 1.0, 1e-12);
      ASSERT_NEAR(glm::dot(frame.u, frame.direction), 0.0, 1e-12);
      ASSERT_LT(frame.v.z, 0.0) << "the head is up";
      ASSERT_NEAR(glm::length(frame.detector_center_lps_mm - frame.source_lps_mm), arm.sid_mm, 1e-9);
      const Shadow shadow = cast(arm, position, isocentre);
      ASSERT_NEAR(glm::length(shadow.detector_mm), 0.0, 1e-9);
      ASSERT_NEAR(shadow.magnification, arm.sid_mm / 785.0, 1e-12) << "SID/SOD";
    }
}

TEST(Shadow, OfAFiducialIsWhereAHandCalculationSays) {
  // From the front, 785 mm to the isocentre, 1100 mm to the detector. A point 40 mm left of, 100 mm nearer to the
  // detector than, and 30 mm above the isocentre: magnified by 1100/885.
  const Shadow ap = cast(arm_at(0, 0), supine, {40, -100, 30});
  EXPECT_NEAR(ap.magnification, 1100.0 / 885.0, 1e-12);
  EXPECT_NEAR(ap.detector_mm.x, 40 * 1100.0 / 885.0, 1e-10) << "the patient's left is right in the picture";
  EXPECT_NEAR(ap.detector_mm.y, -30 * 1100.0 / 885.0, 1e-10) << "the head is up";
  // LAO 30° (degrees, not radians): across = 40·cos 30 − 100·sin 30, ahead = 40·sin 30 + 100·cos 30.
  const Shadow lao = cast(arm_at(30, 0), supine, {40, -100, 30});
  const double ahead = 785.0 + 20.0 + 86.60254037844386;
  EXPECT_NEAR(lao.magnification, 1100.0 / ahead, 1e-11);
  EXPECT_NEAR(lao.detector_mm.x, (34.64101615137755 - 50.0) * 1100.0 / ahead, 1e-9);
  EXPECT_NEAR(lao.detector_mm.y, -30.0 * 1100.0 / ahead, 1e-9);
  // Cranial 20° on the midline: the point 100 mm in front goes down, towards the feet.
  const Shadow cranial = cast(arm_at(0, 20), supine, {0, -100, 0});
  EXPECT_NEAR(cranial.detector_mm.x, 0.0, 1e-9);
  EXPECT_NEAR(cranial.detector_mm.y, 34.20201433256687 * 1100.0 / (785.0 + 93.96926207859084), 1e-9);
}

TEST(Shadow, InLaoTheSpineGoesToTheLeftOfThePatientInThePicture) {
  // Behind the isocentre (+y): as the detector goes to the patient's left, what lies behind goes left too, which is
  // the picture's right; in RAO the other way.
  const glm::dvec3 spine(0, 80, 0);
  EXPECT_NEAR(cast(arm_at(0, 0), supine, spine).detector_mm.x, 0.0, 1e-9);
  EXPECT_GT(cast(arm_at(30, 0), supine, spine).detector_mm.x, 40.0);
  EXPECT_LT(cast(arm_at(-30, 0), supine, spine).detector_mm.x, -40.0);
}

TEST(Shadow, OfAPronePatientIsSeenFromBehind) {
  // From his back his left is at the left; the back is now near the detector.
  const Shadow shadow = cast(arm_at(0, 0), prone, {40, 100, 30});
  EXPECT_NEAR(shadow.detector_mm.x, -40 * 1100.0 / 885.0, 1e-10);
  EXPECT_NEAR(shadow.detector_mm.y, -30 * 1100.0 / 885.0, 1e-10);
  // LAO: the detector goes to his left, so what lies in front (far from the detector) goes left of the patient.
  const double belly = cast(arm_at(30, 0), prone, {0, -80, 0}).detector_mm.x;
  EXPECT_LT(belly, -40.0) << "his left, at the picture's left";
}

TEST(Shadow, BehindTheSourceThereIsNone) {
  const BeamFrame frame = beam_frame(Fluoroscope{}, arm_at(10, 5), supine);
  EXPECT_FALSE(shadow_of(frame, frame.source_lps_mm).has_value());
  EXPECT_FALSE(shadow_of(frame, frame.source_lps_mm - frame.direction).has_value());
  EXPECT_FALSE(shadow_of(frame, glm::dvec3(std::nan(""))).has_value());
}

TEST(InsideField, FollowsMagnificationAndBlades) {
  const Fluoroscope machine;
  EXPECT_TRUE(inside_field(machine, 0, {1.0, 1.0}, {150.0, -150.0}));
  EXPECT_FALSE(inside_field(machine, 0, {1.0, 1.0}, {150.01, 0.0}));
  EXPECT_FALSE(inside_field(machine, 1, {1.0, 1.0}, {100.01, 0.0}));
  EXPECT_TRUE(inside_field(machine, 2, {1.0, 1.0}, {75.0, 75.0}));
  EXPECT_TRUE(inside_field(machine, 0, {0.5, 0.2}, {75.0, -30.0}));
  EXPECT_FALSE(inside_field(machine, 0, {0.5, 0.2}, {75.0, -30.1}));
}

TEST(ViewingAngles, TellDistinctViewsAndTheWidestAngle) {
  ViewingAngles views;
  add_view(0, 0, views);
  EXPECT_EQ(views.count, 1);
  EXPECT_EQ(views.widest_deg, 0.0);
  add_view(4, 0, views);  // the same view
  EXPECT_EQ(views.count, 1);
  EXPECT_NEAR(views.widest_deg, 4.0, 1e-9) << "but it was looked from there";
  add_view(30, 0, views);
  EXPECT_EQ(views.count, 2);
  EXPECT_NEAR(views.widest_deg, 30.0, 1e-9);
  add_view(-40, 0, views);
  EXPECT_EQ(views.count, 3);
  EXPECT_NEAR(views.widest_deg, 70.0, 1e-9);
  add_view(95, 0, views);  // 135° from −40: as lines of sight 45°; 95° from 0: 85°
  EXPECT_EQ(views.count, 4);
  EXPECT_NEAR(views.widest_deg, 85.0, 1e-9);
}

TEST(ViewingAngles, OppositeViewsShowTheSame) {
  ViewingAngles views;
  add_view(-90, 0, views);
  add_view(90, 0, views);
  EXPECT_EQ(views.count, 1);
  EXPECT_NEAR(views.widest_deg, 0.0, 1e-9);
  // Tilted views: the sine of half the angle is cos 40° · sin 20°.
  ViewingAngles tilted;
  add_view(0, 40, tilted);
  add_view(40, 40, tilted);
  EXPECT_NEAR(tilted.widest_deg, 30.377848759873, 1e-9);
}

TEST(ViewingAngles, AFullListStopsCountingButKeepsMeasuring) {
  ViewingAngles views;
  for (int i = 0; i < 60; ++i) add_view(-90 + 6 * (i % 30), i < 30 ? -40 : 20, views);
  EXPECT_EQ(views.count, kMaxViews);
  EXPECT_GT(views.widest_deg, 80.0);
}

}  // namespace
}  // namespace seldinger::cases
