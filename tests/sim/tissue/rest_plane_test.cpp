// The way back by a grid: exact at its nodes, right between them to what a picture asks.
#include "sim/tissue/rest_plane.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

namespace seldinger::tissue {
namespace {

// Under a probe over bone, with a needle in the plane, in a breath.
Displacement moving(double depth_mm) {
  const std::array<SkinPress, 1> press{{{.at_lps_mm = {0, 0, 0},
                                         .inward = {0, 1, 0},
                                         .radius_mm = 20.0,
                                         .depth_mm = depth_mm,
                                         .per_bone_mm = 1.0 / 40.0}}};
  const NeedleDrag needle{.entry_lps_mm = {30, 0, 0},
                          .direction = glm::normalize(glm::dvec3(-0.6, 1.0, 0.0)),
                          .radius_mm = 0.36,
                          .cut_mm = 40.0,
                          .tip_n = 1.5,
                          .tip_mm = 4.0,
                          .shaft_mm = 3.0};
  const Breath breath{{.middle_x_mm = 0.0, .half_width_mm = 170.0, .back_y_mm = 220.0, .depth_mm = 220.0},
                      {1.0, 7.0, 8.0}};
  return displacement_of({.presses = press, .needle = needle, .breath = breath});
}

PlanePart under_the_probe(double angle_rad) {
  return {.first_lps_mm = -50.0 * glm::dvec3(std::cos(angle_rad), 0.0, std::sin(angle_rad)),
          .u = {std::cos(angle_rad), 0.0, std::sin(angle_rad)},
          .v = {0.0, 1.0, 0.0},
          .size_mm = {100.0, 90.0}};
}

TEST(RestPlane, IsRightBetweenItsNodes) {
  for (const double depth_mm : {3.0, 8.0})
    for (const double angle_rad : {0.0, 0.8}) {
      const Displacement displacement = moving(depth_mm);
      const PlanePart part = under_the_probe(angle_rad);
      const RestPlane plane(displacement, part);
      double squares = 0.0, most = 0.0;
      int n = 0;
      for (double a = 0.3; a < 100.0; a += 0.61)
        for (double b = depth_mm + 0.2; b < 90.0; b += 0.61, ++n) {  // what is not tissue is not asked for
          const glm::dvec3 exact = rest_of(displacement, part.first_lps_mm + a * part.u + b * part.v);
          const double miss = glm::length(plane.rest_of(a, b) - exact);
          squares += miss * miss;
          most = std::max(most, miss);
        }
      EXPECT_LT(std::sqrt(squares / n), 0.02) << "of 0.15 mm rms";
      EXPECT_LT(most, 0.35);
      RecordProperty("rms_" + std::to_string(static_cast<int>(depth_mm)), std::to_string(std::sqrt(squares / n)));
      RecordProperty("most_" + std::to_string(static_cast<int>(depth_mm)), std::to_string(most));
    }
}

TEST(RestPlane, IsExactAtItsNodes) {
  const Displacement displacement = moving(6.0);
  const PlanePart part = under_the_probe(0.3);
  const RestPlane plane(displacement, part, 5.0);
  for (int i = 0; i <= 20; ++i)
    for (int j = 0; j <= 18; ++j) {
      const glm::dvec3 at_mm = part.first_lps_mm + 5.0 * i * part.u + 5.0 * j * part.v;
      EXPECT_LT(glm::length(plane.rest_of(5.0 * i, 5.0 * j) - rest_of(displacement, at_mm, {4, 1})), 1e-9);
    }
}

TEST(RestPlane, GoesOnBeyondItsBorderAndIsLostWhereThePlaneIs) {
  const RestPlane still({}, {.size_mm = {10.0, 10.0}});
  EXPECT_EQ(still.rest_of(-3.0, 14.0), glm::dvec3(-3.0, 14.0, 0.0));
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(std::isnan(still.rest_of(kNan, 1.0).x));
  const RestPlane lost(moving(5.0), {.first_lps_mm = glm::dvec3(kNan), .size_mm = {10.0, 10.0}});
  EXPECT_TRUE(std::isnan(lost.rest_of(1.0, 1.0).x));
}

}  // namespace
}  // namespace seldinger::tissue
