// Tests of sim/haptics/contact/soft_contact, probe_law and bone_depth: closed forms, no switch, no energy, rest
// under hands.
#include "sim/haptics/probe/probe_law.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "sim/base/rng.h"
#include "sim/haptics/probe/bone_depth.h"
#include "sim/volume/analytic.h"
#include "tests/fixtures/allocations.h"

namespace seldinger::haptics {
namespace {

constexpr double kNone = std::numeric_limits<double>::infinity();
constexpr double kBonesMm[] = {kNone, 60.0, 30.0, 15.0, 8.0, 4.0, 2.0};

// Stiffer than any contact here, so that nothing is cut off.
constexpr SoftContact kFree{20.0, 0.0033, 1e9};

TEST(SoftContact, WithoutBoneIsHertz) {
  // 16/3 G √(R δ) δ, and by hand: 1.8 N and 0.34 N/mm at 8 mm.
  EXPECT_NEAR(kFree.force_n(8.0, 0.0), 16.0 / 3.0 * 0.0033 * std::sqrt(20.0 * 8.0) * 8.0, 1e-12);
  EXPECT_NEAR(kFree.force_n(8.0, 0.0), 1.8, 0.05);
  EXPECT_NEAR(kFree.stiffness_n_mm(8.0, 0.0), 0.34, 0.01);
  EXPECT_EQ(kFree.force_n(0.0, 0.1), 0.0);
  EXPECT_EQ(kFree.force_n(-1.0, 0.1), 0.0);
  // Mindlin: sideways 8 G a / (2 − ν) with ν 0.5.
  EXPECT_NEAR(kFree.side_stiffness_n_mm(5.0), 8.0 * 0.0033 * 10.0 / 1.5, 1e-12);
}

// The layer's coefficients against the general formula for any Poisson's ratio ν, of a bonded layer (Dimitriadis
// 2002).
TEST(SoftContact, OverBoneFollowsTheSeriesOfAThinLayer) {
  const double nu = 0.5, pi = 3.141592653589793;
  const double alpha = -(1.2876 - 1.4678 * nu + 1.3442 * nu * nu) / (1.0 - nu);
  const double beta = (0.6387 - 1.0277 * nu + 1.5164 * nu * nu) / (1.0 - nu);
  const double first = -2.0 * alpha / pi, second = 4.0 * alpha * alpha / (pi * pi);
  const double third = -8.0 / (pi * pi * pi) * (alpha * alpha * alpha + 4.0 * pi * pi / 15.0 * beta);
  for (const double chi : {0.05, 0.1, 0.2}) {
    const double depth_mm = 5.0, bone_mm = std::sqrt(20.0 * depth_mm) / chi;
    const double ratio = kFree.force_n(depth_mm, 1.0 / bone_mm) / kFree.force_n(depth_mm, 0.0);
    EXPECT_NEAR(ratio, 1.0 + first * chi + second * chi * chi + third * chi * chi * chi, 1e-3) << chi;
  }
}

TEST(SoftContact, RisesSteadilyAndNeverAboveItsStiffness) {
  const SoftContact contact;
  for (const double bone_mm : kBonesMm) {
    double last = 0.0, last_slope = 0.0;
    for (double depth_mm = 0.005; depth_mm < 20.0; depth_mm += 0.01) {
      const double force = contact.force_n(depth_mm, 1.0 / bone_mm);
      const double slope = contact.stiffness_n_mm(depth_mm - 0.005, 1.0 / bone_mm);
      ASSERT_GE(force, last);
      ASSERT_LE(force - last, contact.most_stiffness_n_mm * 0.01 * (1.0 + 1e-9));
      // The stated slope is the force's own.
      if (depth_mm > 0.1) {
        ASSERT_NEAR((force - last) / 0.01, slope, 1.5e-3) << depth_mm << " bone " << bone_mm;
      }
      ASSERT_GE(slope, last_slope) << "no softening";
      last = force;
      last_slope = slope;
    }
  }
  for (const double depth_mm : {0.5, 3.0, 10.0}) {
    double last = contact.force_n(depth_mm, 0.0);
    for (double per_bone = 0.0; per_bone <= 0.5; per_bone += 0.001) {
      const double force = contact.force_n(depth_mm, per_bone);
      ASSERT_GE(force, last) << "the nearer the bone, the harder";
      ASSERT_LE(force - last, 0.003 * depth_mm * depth_mm) << "and no step";
      last = force;
    }
  }
}

SkinTouch touch(const glm::dvec3& at, double depth_mm, double bone_mm = kNone) {
  return {at, {0.0, 0.0, 1.0}, depth_mm, bone_mm};
}

TEST(ProbeLaw, PressesOutwardsWithTheContactsForce) {
  const ProbeLaw law({});
  ProbeTrack track;
  ProbeForce force;
  for (int i = 0; i < 2000; ++i) force = law.advance(touch({0, 0, -6.0}, 6.0, 15.0), track);
  const double expected = SoftContact{20.0, 0.0033, ProbeSettings{}.stiffness_n_mm}.force_n(6.0, 1.0 / 15.0);
  EXPECT_NEAR(force.force_n.z, expected, 1e-9);
  EXPECT_NEAR(force.pressure_n, expected, 1e-9);
  EXPECT_NEAR(force.force_n.x, 0.0, 1e-12);
  force = law.advance(touch({0, 0, 1.0}, -1.0), track);
  EXPECT_EQ(force.force_n, glm::dvec3(0.0));
  EXPECT_FALSE(track.touching);
}

TEST(ProbeLaw, SlidesAgainstFrictionAndSticksBelowIt) {
  const ProbeSettings settings;
  const ProbeLaw law(settings);
  ProbeTrack track;
  ProbeForce force;
  double x = 0.0;
  for (int i = 0; i < 1000; ++i) force = law.advance(touch({x += 0.02, 0, -5.0}, 5.0), track);
  EXPECT_NEAR(force.friction_n.x, -settings.friction * force.pressure_n, 1e-9);
  EXPECT_NEAR(force.force_n.x, force.friction_n.x, 1e-6) << "no damper at a steady speed";
  const double held = force.force_n.x;
  for (int i = 0; i < 1000; ++i) force = law.advance(touch({x, 0, -5.0}, 5.0), track);
  EXPECT_NEAR(force.force_n.x, held, 1e-6) << "at rest it holds";
  // Back by less than the spring's way it does not slide.
  const double side = SoftContact{}.side_stiffness_n_mm(5.0);
  force = law.advance(touch({x - 0.5, 0, -5.0}, 5.0), track);
  EXPECT_NEAR(force.friction_n.x, held + 0.5 * side, 1e-9);
}

// What a hand puts in and gets back, in all directions, over a flat and over a round skin.
TEST(ProbeLaw, GivesNoEnergy) {
  for (const bool round : {false, true})
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
      const ProbeLaw law({});
      ProbeTrack track;
      base::Rng rng(seed);
      glm::dvec3 at(0.0, 0.0, 1.0), speed(0.0), force(0.0);
      double work_mj = 0.0, least_mj = 0.0;
      for (int i = 0; i < 60000; ++i) {
        for (int axis = 0; axis < 3; ++axis)
          speed[axis] = std::clamp(speed[axis] + 2.0 * rng.normal() - 0.002 * at[axis], -100.0, 100.0);
        const glm::dvec3 moved = 0.001 * speed;
        work_mj -= glm::dot(force, moved);
        at += moved;
        at.z = std::clamp(at.z, -10.0, 3.0);
        // Round: a trunk of 150 mm radius along x.
        const glm::dvec3 from_axis(0.0, at.y, at.z + 150.0);
        const double distance = glm::length(from_axis);
        const SkinTouch here = round ? SkinTouch{at, from_axis / distance, 150.0 - distance, 12.0}
                                     : SkinTouch{at, {0.0, 0.0, 1.0}, -at.z, 12.0};
        force = law.advance(here, track).force_n;
        least_mj = std::min(least_mj, work_mj);
      }
      EXPECT_GE(least_mj, -1.0) << (round ? "round " : "flat ") << seed;
      EXPECT_GT(work_mj, 1.0) << "friction takes";
    }
}

// A ring that would pump energy out of a spring that stiffens: shift where it is soft, come back where it is stiff.
TEST(ProbeLaw, StiffeningUnderShearGivesNothing) {
  ProbeSettings settings;
  settings.damping_n_s_mm = 0.0;
  const ProbeLaw law(settings);
  ProbeTrack track;
  glm::dvec3 at(0.0, 0.0, -2.0), force = law.advance(touch(at, 2.0), track).force_n;
  double work_mj = 0.0;
  const auto go = [&](const glm::dvec3& target) {
    const glm::dvec3 step = (target - at) / 200.0;
    for (int i = 0; i < 200; ++i) {
      at += step;
      const glm::dvec3 next = law.advance(touch(at, -at.z), track).force_n;
      work_mj -= 0.5 * glm::dot(force + next, step);
      force = next;
    }
  };
  for (int round = 0; round < 50; ++round) {
    const double before_mj = work_mj;
    go({0.2, 0.0, -2.0});
    go({0.2, 0.0, -8.0});
    go({0.0, 0.0, -8.0});
    go({0.0, 0.0, -2.0});
    if (round > 0) {
      EXPECT_GE(work_mj - before_mj, -1e-5);
    }
  }
}

TEST(ProbeLaw, ARibsEdgeIsNoStep) {
  const ProbeLaw law({});
  for (const double speed_mm_s : {5.0, 50.0, 200.0}) {
    ProbeTrack track;
    double x = 0.0, last = 0.0, soft = 0.0, hard = 0.0;
    for (int i = 0; i < 3000; ++i) {
      x += 0.001 * speed_mm_s;
      const double bone_mm = i > 1000 && i < 2000 ? 10.0 : kNone;
      const ProbeForce force = law.advance(touch({x, 0, -6.0}, 6.0, bone_mm), track);
      if (i > 0) {
        EXPECT_LE(std::abs(force.pressure_n - last), 0.15) << i;
      }
      last = force.pressure_n;
      if (i == 1000) soft = last;
      if (i == 1999) hard = last;
    }
    EXPECT_GT(hard, 1.5 * soft) << "and a rib is felt";
  }
}

TEST(ProbeLaw, AllocatesNothingAndRepeatsItself) {
  const ProbeLaw law({});
  ProbeTrack track;
  const long before = fixtures::allocations();
  double sum = 0.0;
  for (int i = 0; i < 1000; ++i) sum += law.advance(touch({0.01 * i, 0, -5.0}, 0.01 * i, 20.0), track).force_n.z;
  EXPECT_EQ(fixtures::allocations(), before);
  track = {};
  double again = 0.0;
  for (int i = 0; i < 1000; ++i) again += law.advance(touch({0.01 * i, 0, -5.0}, 0.01 * i, 20.0), track).force_n.z;
  EXPECT_EQ(sum, again);
}

// A slab of bone, its surface at z = −z0, under a body; then tilted rays and a step of the skin's place.
struct Slab {
  volume::Volume volume;
  std::vector<volume::TissueClass> classes;
  Slab() {
    volume::AnalyticVolume analytic;
    analytic.size_voxels = {60, 60, 60};
    analytic.spacing_mm = {0.8, 0.8, 1.5};
    analytic.origin_mm = {-23.6, -23.6, -80.0};
    analytic.background_hu = 40.0;
    volume = rasterize(analytic);
    classes.assign(volume.hu.size(), volume::TissueClass::soft_tissue);
    for (int k = 0; k < 60; ++k)
      for (int j = 0; j < 60; ++j)
        for (int i = 0; i < 60; ++i) {
          const double x = -23.6 + 0.8 * i, z = -80.0 + 1.5 * k;
          if (z < -20.0 + 0.5 * x) classes[volume.index(i, j, k)] = volume::TissueClass::bone;
        }
  }
};

TEST(BoneDepth, FindsBoneAlongTheRayAndMovesSmoothly) {
  const Slab slab;
  const BoneDepth bone(slab.volume, slab.classes);
  double last = NAN;
  for (double x = -10.0; x < 10.0; x += 0.02) {
    const double depth = bone.along({x, 1.3, 0.0}, {0.0, 0.0, -1.0}, 60.0);
    EXPECT_NEAR(depth, 20.0 - 0.5 * x, 0.9) << "within the voxel's reach";
    if (x > -10.0) {
      EXPECT_NEAR(depth, last, 0.1) << "no stairs at " << x;
    }
    last = depth;
  }
  const glm::dvec3 oblique = glm::normalize(glm::dvec3(0.3, 0.2, -1.0));
  // z = −20 + x/2 from (0, 0, 0) along the ray.
  EXPECT_NEAR(bone.along({0.0, 0.0, 0.0}, oblique, 60.0), -20.0 / (oblique.z - 0.5 * oblique.x), 0.9);
  EXPECT_EQ(bone.along({0.0, 0.0, 0.0}, {0.0, 0.0, -1.0}, 10.0), kNone) << "not that deep";
  EXPECT_EQ(bone.along({0.0, 0.0, 0.0}, {0.0, 0.0, 1.0}, 60.0), kNone);
  EXPECT_EQ(bone.along({500.0, 0.0, 0.0}, {0.0, 0.0, -1.0}, 60.0), kNone) << "beside the volume";
  EXPECT_EQ(bone.along({0.0, 0.0, -40.0}, {0.0, 0.0, -1.0}, 60.0), 0.0) << "in bone";
}

}  // namespace
}  // namespace seldinger::haptics
