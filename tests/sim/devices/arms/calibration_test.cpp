// Tests of sim/devices/arms/calibration: a known placement comes back, and points that cannot tell one are refused.
#include "sim/devices/arms/calibration.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/matrix.hpp>
#include <limits>

#include "sim/base/rng.h"

namespace seldinger::devices {
namespace {

using testing::ElementsAre;
using Points = std::vector<TakenPoint>;

// The thesis turns its devices by 45°; this one leans, too.
Placement planted() {
  const glm::dmat4 turn = glm::rotate(glm::rotate(glm::dmat4(1.0), glm::radians(45.0), glm::dvec3(0, 1, 0)),
                                      glm::radians(7.0), glm::normalize(glm::dvec3(1, 0, 0.3)));
  return {glm::dmat3(turn), 1.08, {-18.0, 110.0, 25.0}};
}

glm::dvec3 device_of(const Placement& placement, const glm::dvec3& template_mm) {
  return glm::transpose(placement.rotation) * (template_mm - placement.translation_mm) / placement.scale;
}

// As taken by a device so placed; f somewhere on the box.
Points taken_by(const Placement& placement, double noise_mm = 0.0, std::uint64_t seed = 1) {
  Points points;
  std::uint64_t drawn = 0;
  for (const TemplatePoint& point : template_points()) {
    const glm::dvec3 beside = point.height_only ? glm::dvec3(21.0, 0.0, -13.0) : glm::dvec3(0.0);
    glm::dvec3 device_mm = device_of(placement, point.template_mm + beside);
    for (int axis = 0; axis < 3; ++axis) device_mm[axis] += noise_mm * base::normal_at(seed, drawn++);
    points.push_back({point.name, device_mm});
  }
  return points;
}

std::vector<std::string> codes_of(const base::Error& error) {
  std::vector<std::string> codes{error.code};
  for (const base::Problem& finding : error.findings) codes.push_back(finding.code);
  return codes;
}

std::vector<std::string> refused(const Points& points) {
  const auto calibration = calibrate(points);
  return calibration ? std::vector<std::string>{"accepted"} : codes_of(calibration.error());
}

double angle_deg(const glm::dmat3& a, const glm::dmat3& b) {
  const glm::dmat3 between = glm::transpose(a) * b;
  const glm::dvec3 twice_sine(between[1][2] - between[2][1], between[2][0] - between[0][2],
                              between[0][1] - between[1][0]);
  return glm::degrees(std::asin(std::min(1.0, 0.5 * glm::length(twice_sine))));
}

TEST(Template, IsTheThesis) {
  const auto points = template_points();
  ASSERT_EQ(points.size(), 6U);
  EXPECT_EQ(points[0].template_mm, glm::dvec3(-64, 0, 0));
  EXPECT_EQ(points[1].template_mm, glm::dvec3(64, 0, 0));
  EXPECT_EQ(points[2].template_mm, glm::dvec3(0, 0, -64));
  EXPECT_EQ(points[3].template_mm, glm::dvec3(0, 0, 64));
  EXPECT_EQ(points[5].template_mm.y, 143.0);
  EXPECT_TRUE(points[5].height_only);
}

TEST(Calibrate, FindsAKnownPlacementExactly) {
  for (const double scale : {0.2, 1.0, 1.08, 5.0})
    for (const double turn_deg : {0.0, 45.0, 90.0, 179.999, 180.0, -60.0}) {
      Placement there = planted();
      there.scale = scale;
      there.rotation = glm::dmat3(glm::rotate(glm::dmat4(there.rotation), glm::radians(turn_deg),
                                              glm::normalize(glm::dvec3(0.2, 1.0, -0.4))));
      for (const bool with_e : {true, false}) {
        Points points = taken_by(there);
        if (!with_e) points.erase(points.begin() + 4);
        const auto found = calibrate(points);
        ASSERT_TRUE(found) << turn_deg << ": " << found.error().text;
        const Placement& placement = found->template_from_device;
        EXPECT_NEAR(placement.scale, scale, 1e-9);
        EXPECT_LE(angle_deg(placement.rotation, there.rotation), 1e-7);
        EXPECT_LE(glm::length(placement.translation_mm - there.translation_mm), 1e-7);
        EXPECT_NEAR(glm::determinant(placement.rotation), 1.0, 1e-12);
        EXPECT_LE(found->residual_max_mm, 1e-8);
        ASSERT_EQ(found->points.size(), points.size());
      }
    }
}

// Noise of 0.1 mm a coordinate: on arms of 64 mm that is 0.1 / 64 / sqrt(2) rad = 0.06° a turn; four times that and
// the like for the rest.
TEST(Calibrate, FindsAKnownPlacementUnderNoise) {
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    const auto found = calibrate(taken_by(planted(), 0.1, seed));
    ASSERT_TRUE(found) << found.error().text;
    EXPECT_LE(angle_deg(found->template_from_device.rotation, planted().rotation), 0.4);
    EXPECT_NEAR(found->template_from_device.scale, planted().scale, 0.005);
    const glm::dvec3 at_work(10.0, 60.0, 20.0);
    EXPECT_LE(glm::length(found->template_from_device(device_of(planted(), at_work)) - at_work), 0.6);
    EXPECT_GT(found->residual_rms_mm, 0.01);
    EXPECT_LE(found->residual_rms_mm, 0.25);
  }
}

// The sum of squares cannot be made smaller by any small turn, shift or stretch: least squares, f by height only.
TEST(Calibrate, IsLeastSquaresAndStatesItsResidualsExactly) {
  const Points points = taken_by(planted(), 0.2, 3);
  const auto found = calibrate(points);
  ASSERT_TRUE(found);
  const auto squares = [&](const Placement& placement) {
    double sum = 0.0;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const glm::dvec3 off = placement(points[i].device_mm) - template_points()[i].template_mm;
      sum += template_points()[i].height_only ? off.y * off.y : glm::dot(off, off);
    }
    return sum;
  };
  const double least = squares(found->template_from_device);
  EXPECT_NEAR(found->residual_rms_mm, std::sqrt(least / 6.0), 1e-12);
  double most = 0.0;
  for (const auto& point : found->points) most = std::max(most, point.residual_mm);
  EXPECT_EQ(found->residual_max_mm, most);
  for (const double step : {1e-4, -1e-4}) {
    for (int axis = 0; axis < 3; ++axis) {
      Placement other = found->template_from_device;
      glm::dvec3 along(0.0);
      along[axis] = 1.0;
      other.translation_mm += 10.0 * step * along;
      EXPECT_GT(squares(other), least);
      other = found->template_from_device;
      other.rotation = glm::dmat3(glm::rotate(glm::dmat4(1.0), step, along)) * other.rotation;
      other.translation_mm = glm::dmat3(glm::rotate(glm::dmat4(1.0), step, along)) * other.translation_mm;
      EXPECT_GT(squares(other), least);
    }
    Placement other = found->template_from_device;
    other.scale *= 1.0 + step;
    other.translation_mm *= 1.0 + step;
    EXPECT_GT(squares(other), least);
  }
}

TEST(Calibrate, RefusesAMirroredDevice) {
  for (int axis = 0; axis < 3; ++axis) {
    Points points = taken_by(planted(), 0.1);
    for (TakenPoint& point : points) point.device_mm[axis] *= -1.0;
    EXPECT_THAT(refused(points), ElementsAre("mirrored")) << axis;
  }
  Points points = taken_by(planted());
  std::swap(points[0].device_mm, points[1].device_mm);
  EXPECT_THAT(refused(points), ElementsAre("mirrored")) << "a for b";
}

TEST(Calibrate, RefusesPointsThatTellNoPlacement) {
  Points points = taken_by(planted());
  for (TakenPoint& point : points) point.device_mm = points[0].device_mm;
  EXPECT_THAT(refused(points), ElementsAre("collinear")) << "on one spot";
  for (std::size_t i = 0; i < points.size(); ++i)
    points[i].device_mm = glm::dvec3(3.0, -5.0, 1.0) * static_cast<double>(i) + glm::dvec3(10.0);
  EXPECT_THAT(refused(points), ElementsAre("collinear")) << "on one line";
  points = taken_by(planted());
  points[5].device_mm = device_of(planted(), {20.0, 2.0, -30.0});
  EXPECT_THAT(refused(points), ElementsAre("coplanar")) << "f on the board";
  points = taken_by(planted());
  for (TakenPoint& point : points) point.device_mm *= 1e-3;
  EXPECT_THAT(refused(points), ElementsAre("collinear")) << "metres";
  for (TakenPoint& point : points) point.device_mm *= 1e6;
  EXPECT_THAT(refused(points), ElementsAre("wrong_scale")) << "micrometres";
  for (TakenPoint& point : points) point.device_mm *= 1e300;
  EXPECT_NE(refused(points).front(), "accepted");
}

TEST(Calibrate, RefusesAboveAMillimetreAndNamesTheWrongPoint) {
  for (std::size_t wrong = 0; wrong < 6; ++wrong) {
    Points points = taken_by(planted(), 0.05);
    const glm::dvec3 off = wrong == 5 ? glm::dvec3(0.0, 12.0, 0.0) : glm::dvec3(5.0, 3.0, 2.0);
    points[wrong].device_mm += glm::transpose(planted().rotation) * off / planted().scale;
    const auto calibration = calibrate(points);
    ASSERT_FALSE(calibration) << wrong;
    EXPECT_EQ(calibration.error().code, "wrong_point");
    ASSERT_FALSE(calibration.error().findings.empty());
    EXPECT_EQ(calibration.error().findings.back().text,
              std::string("without point ") + points[wrong].name + " the others agree");
  }
  // Right at the limit: e off along y by so much that its residual is just below and just above 1 mm.
  const auto raised = [](double by_mm) {
    Placement flat;
    Points points = taken_by(flat);
    points[4].device_mm.y += by_mm;
    return calibrate(points);
  };
  ASSERT_TRUE(raised(1.0));
  const double share = raised(1.0)->residual_max_mm;
  EXPECT_TRUE(raised(0.98 / share));
  EXPECT_FALSE(raised(1.02 / share));
}

TEST(Calibrate, RefusesWrongNamesWithEveryFault) {
  Points points = taken_by(planted());
  points.push_back(points[0]);
  points[2].name = "g";
  points[3].device_mm.x = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(refused(points), ElementsAre("bad_points", "bad_points", "bad_points", "bad_points"));
  EXPECT_THAT(refused({}), testing::SizeIs(5)) << "a, b, c, d, f";
}

TEST(ClosestPlacement, NeverMirrors) {
  std::vector<glm::dvec3> from, to;
  for (std::uint64_t i = 0; i < 8; ++i) {
    from.push_back({base::normal_at(2, 3 * i), base::normal_at(2, 3 * i + 1), base::normal_at(2, 3 * i + 2)});
    to.push_back(from.back() * glm::dvec3(1.0, 1.0, -1.0));
  }
  EXPECT_NEAR(glm::determinant(closest_placement(from, to).rotation), 1.0, 1e-12);
}

}  // namespace
}  // namespace seldinger::devices
