// Displacement on a grid about a plane: right between its nodes to what a picture asks, its own way back, and
// bounds that hold.
#include "sim/tissue/moved_slab.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec4.hpp>
#include <limits>

#include "sim/base/rng.h"

namespace seldinger::tissue {
namespace {

// Under a probe over bone, with a needle in the plane, in a breath.
Displacement moving() {
  const std::array<SkinPress, 1> press{{{.at_lps_mm = {0, 0, 0},
                                         .inward = {0, 1, 0},
                                         .radius_mm = 20.0,
                                         .depth_mm = 8.0,
                                         .per_bone_mm = 1.0 / 40.0}}};
  const NeedleDrag needle{.entry_lps_mm = {30, 0, 0},
                          .direction = glm::normalize(glm::dvec3(-0.6, 1.0, 0.0)),
                          .radius_mm = 0.36,
                          .cut_mm = 40.0,
                          .tip_n = 1.5,
                          .tip_mm = 2.0,
                          .shaft_mm = 2.0};
  const Breath breath{{.middle_x_mm = 0.0, .half_width_mm = 170.0, .back_y_mm = 220.0, .depth_mm = 220.0},
                      {1.0, 7.0, 8.0}};
  return displacement_of({.presses = press, .needle = needle, .breath = breath});
}

// Tilted, so that no axis of LPS lies in it.
SlabPart tilted(double spacing_mm) {
  SlabPart part;
  part.normal = glm::normalize(glm::dvec3(0.5, 0.2, 0.9));
  part.low_mm = {-50.0, 9.0, -12.0};
  part.high_mm = {50.0, 90.0, 12.0};
  part.spacing_mm = part.layer_mm = spacing_mm;
  return part;
}

glm::dvec3 place(const SlabPart& part, base::Rng& rng) {
  glm::dvec3 in;
  for (int l = 0; l < 3; ++l) in[l] = part.low_mm[l] + rng.uniform() * (part.high_mm[l] - part.low_mm[l]);
  const glm::dvec3 flat(in.x, in.y, 0.0);
  return {in.x, in.y, (in.z - glm::dot(part.normal, flat)) / part.normal.z};
}

TEST(MovedSlab, IsRightBetweenItsNodesAndBetterTheFinerItIs) {
  const Displacement displacement = moving();
  double before = 1.0;
  for (const double spacing_mm : {4.0, 2.0, 1.0}) {
    const SlabPart part = tilted(spacing_mm);
    const MovedSlab slab(displacement, part);
    base::Rng rng(3);
    double squares = 0.0;
    constexpr int kPlaces = 20000;
    for (int i = 0; i < kPlaces; ++i) {
      const glm::dvec3 rest = place(part, rng);
      const glm::dvec3 miss = slab.moved_mm(rest) - (displaced(displacement, rest) - rest);
      squares += glm::dot(miss, miss);
      // The columns about it say the same.
      const glm::dvec3 in = slab.slab_of(rest);
      const double layer = (in.z - part.low_mm.z) / part.layer_mm;
      const int below = static_cast<int>(layer);
      const auto between = slab.between(in.x, in.y);
      const auto at = [&](int one) {
        const auto beside = [&](int j) {
          return glm::mix(slab.column(between.i, j)[one], slab.column(between.i + 1, j)[one], between.right);
        };
        return glm::mix(beside(between.j), beside(between.j + 1), between.down);
      };
      const glm::vec3 u(glm::mix(at(below), at(below + 1), static_cast<float>(layer - below)));
      ASSERT_LT(glm::length(glm::dvec3(u) - slab.moved_mm(rest)), 1e-4);
    }
    const double rms = std::sqrt(squares / kPlaces);
    RecordProperty("rms_um_" + std::to_string(static_cast<int>(spacing_mm)), static_cast<int>(1e3 * rms));
    EXPECT_LT(rms, 0.6 * before) << spacing_mm;
    EXPECT_LT(rms, 0.03 * spacing_mm) << spacing_mm;
    before = rms;
  }
}

TEST(MovedSlab, IsStillWhereNothingMoves) {
  const SlabPart part = tilted(3.0);
  EXPECT_TRUE(MovedSlab({}, part).is_still(part.low_mm, part.high_mm));
  EXPECT_FALSE(MovedSlab(moving(), part).is_still(part.low_mm, part.high_mm));
}

TEST(MovedSlab, FindsItsOwnWayBack) {
  const SlabPart part = tilted(3.0);
  const MovedSlab slab(moving(), part);
  base::Rng rng(4);
  for (int i = 0; i < 5000; ++i) {
    const glm::dvec3 rest = place(part, rng), at = rest + slab.moved_mm(rest);
    const glm::dvec3 near = rest + 0.5 * glm::dvec3(rng.uniform(), rng.uniform(), rng.uniform());
    ASSERT_LT(glm::length(slab.rest_of(at, near) - rest), 0.01);
  }
}

TEST(MovedSlab, StretchesAsItMoves) {
  const SlabPart part = tilted(3.0);
  const MovedSlab slab(moving(), part);
  base::Rng rng(5);
  for (int i = 0; i < 1000; ++i) {
    const glm::dvec3 rest = place(part, rng);
    const glm::dmat3 stretch = slab.stretch(rest);
    for (int l = 0; l < 3; ++l) {
      glm::dvec3 on(rest);
      on[l] += 1e-4;
      const glm::dvec3 by = (on - rest + slab.moved_mm(on) - slab.moved_mm(rest)) * 1e4;
      // Not where the step crosses into the next cell.
      const glm::dvec3 a = (slab.slab_of(rest) - part.low_mm) / 3.0, b = (slab.slab_of(on) - part.low_mm) / 3.0;
      if (glm::floor(a) != glm::floor(b)) continue;
      ASSERT_LT(glm::length(by - stretch[l]), 0.01);
    }
  }
}

TEST(MovedSlab, ItsBoundsHold) {
  const SlabPart part = tilted(4.0);
  const MovedSlab slab(moving(), part);
  const glm::dvec3 z = part.normal, x = glm::normalize(glm::cross(glm::dvec3(0, 1, 0), z));
  const glm::dvec3 axes[3] = {x, glm::cross(z, x), z};
  base::Rng rng(6);
  for (int i = 0; i < 300; ++i) {
    const glm::dvec3 middle = slab.slab_of(place(part, rng)), half(5.0, 6.0, 4.0);
    const auto range = slab.range(middle - half, middle + half, axes);
    for (int j = 0; j < 20; ++j) {
      const glm::dvec3 in = middle + half * (2.0 * glm::dvec3(rng.uniform(), rng.uniform(), rng.uniform()) - 1.0);
      const glm::dvec3 flat(in.x, in.y, 0.0);
      const glm::dvec3 u = slab.moved_mm({in.x, in.y, (in.z - glm::dot(part.normal, flat)) / part.normal.z});
      for (int l = 0; l < 3; ++l) {
        ASSERT_GE(glm::dot(u, axes[l]), range.low_mm[l] - 1e-5);
        ASSERT_LE(glm::dot(u, axes[l]), range.high_mm[l] + 1e-5);
      }
    }
  }
}

TEST(MovedSlab, NoPlaceIsFoundNowhere) {
  const MovedSlab slab(moving(), tilted(4.0));
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(std::isfinite(slab.moved_mm({1e9, -1e9, 1e9}).x));
  EXPECT_TRUE(std::isnan(slab.rest_of(glm::dvec3(kNan), glm::dvec3(0.0)).x));
}

}  // namespace
}  // namespace seldinger::tissue
