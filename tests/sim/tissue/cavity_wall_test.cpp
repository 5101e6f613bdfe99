// Organs slide along the trunk's wall: where the wall is, against the shapes that built-in patients are made of;
// what the law moves, against its closed form.
#include "sim/tissue/cavity_wall.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <memory>
#include <vector>

#include "sim/base/rng.h"
#include "sim/tissue/displacement.h"
#include "sim/tissue/rest_plane.h"
#include "sim/volume/phantom.h"
#include "sim/volume/tissue/find_tissue.h"

namespace seldinger::tissue {
namespace {

using volume::TissueClass;

glm::dvec3 breath_mm(double depth) {
  return depth * cases::breath::kQuietMm;
}

// Scanned coarsely, so that it is made in no time. Its skin is the box about the body: nothing here asks for more.
cases::Case patient(volume::Body body, bool labelled) {
  const volume::Phantom made = volume::make_phantom({.spacing_mm = glm::dvec3(2.0, 2.0, 5.0), .body = body});
  cases::Case scene;
  scene.volume = made.volume;
  scene.classes = volume::tissue_classes(scene.volume, labelled ? &made.labels : nullptr);
  glm::dvec3 low(1e9), high(-1e9);
  std::size_t at = 0;
  for (int k = 0; k < scene.volume.size_voxels.z; ++k)
    for (int j = 0; j < scene.volume.size_voxels.y; ++j)
      for (int i = 0; i < scene.volume.size_voxels.x; ++i, ++at) {
        if (scene.classes[at] == TissueClass::air) continue;
        const glm::dvec3 lps_mm(scene.volume.lps_from_voxel * glm::dvec4(i, j, k, 1.0));
        low = glm::min(low, lps_mm);
        high = glm::max(high, lps_mm);
      }
  scene.skin.vertices_lps_mm = {glm::vec3(low), glm::vec3(high)};
  return scene;
}

double radius_mm(const CavityWall& wall, int height, int way) {
  return static_cast<double>(wall.radius_mm[static_cast<std::size_t>(height * shaders::kCavityWays + way)]);
}

// An axis at 0, as far everywhere as it is said by height.
template <typename Radius>
CavityWall funnel(const Radius& radius) {
  CavityWall wall;
  wall.axis_lps_mm = {0.0, 0.0, -230.0};
  wall.step_mm = 20.0;
  for (int h = 0; h < shaders::kCavityHeights; ++h)
    for (int w = 0; w < shaders::kCavityWays; ++w)
      wall.radius_mm[static_cast<std::size_t>(h * shaders::kCavityWays + w)] =
          static_cast<float>(radius(-230.0 + 20.0 * h));
  return wall;
}

// Built-in patients' wall is between ellipses: 35 mm within the adult's outline at its sides, 32 at its front (133
// mm from the middle, y −82), whatever fat lies over it; a diaphragm that lies on it counts as wall. Without labels
// bone and the muscles' outside tell it.
TEST(CavityWall, IsWhereBuiltInPatientsHaveIt) {
  for (const volume::Body body : {volume::Body::adult, volume::Body::lean, volume::Body::obese})
    for (const bool labelled : {true, false}) {
      const auto wall = cavity_wall(patient(body, labelled));
      ASSERT_TRUE(wall.has_value());
      EXPECT_NEAR(wall->axis_lps_mm.x, 0.0, 2.0);
      for (int h = 4; h < shaders::kCavityHeights; ++h) {
        EXPECT_NEAR(radius_mm(*wall, h, 0), 133.0, 7.0) << h << labelled;
        EXPECT_NEAR(radius_mm(*wall, h, 16), 133.0, 7.0) << h << labelled;
        EXPECT_NEAR(wall->axis_lps_mm.y - radius_mm(*wall, h, 24), -82.0, 4.0) << h << labelled;
      }
    }
  const auto child = cavity_wall(patient(volume::Body::child, true));
  ASSERT_TRUE(child.has_value());
  EXPECT_NEAR(radius_mm(*child, 12, 0), 0.7 * 133.0, 4.0);
}

TEST(CavityWall, IsToldOfClassesAndBone) {
  cases::Case scene;
  EXPECT_FALSE(cavity_wall(scene).has_value());
  scene = patient(volume::Body::lean, false);
  EXPECT_EQ(cavity_wall(scene)->radius_mm, cavity_wall(scene)->radius_mm) << "the same from the same";
  std::replace(scene.classes.begin(), scene.classes.end(), TissueClass::bone, TissueClass::soft_tissue);
  EXPECT_FALSE(cavity_wall(scene).has_value()) << "nothing says where its axis is";
  scene.classes.clear();
  EXPECT_FALSE(cavity_wall(scene).has_value());
}

// What touches the wall goes along whole, and the wall does not: at each height all of the way is between 4 mm
// outside and 10 mm inside, in front and at both sides. By the law of before a third to nine tenths of it reached
// the wall.
TEST(CavityWall, PartsWhatSlidesFromWhatStays) {
  const cases::Case scene = patient(volume::Body::adult, true);
  const BreathRegion region = breath_region(scene).value();
  const CavityWall wall = cavity_wall(scene).value();
  const Displacement now = displacement_of({.breath = Breath{region, breath_mm(1.0), &wall}}),
                     before = displacement_of({.breath = Breath{region, breath_mm(1.0)}});
  const auto down_mm = [](const Displacement& d, const glm::dvec3& at) { return at.z - displaced(d, at).z; };
  for (const double z_mm : {100.0, 50.0, 0.0, -60.0, -120.0})
    for (const glm::dvec3& edge : {glm::dvec3(133, -13, z_mm), {-133, -13, z_mm}, {0, -82, z_mm}}) {
      const glm::dvec3 axis(wall.axis_lps_mm.x, wall.axis_lps_mm.y, z_mm);
      const glm::dvec3 outwards = glm::normalize(edge - axis);
      const glm::dvec3 inside = edge - 14.0 * outwards, outside = edge + 6.0 * outwards;
      const double whole_mm = down_mm(now, {0.0, -40.0, z_mm});
      EXPECT_GT(whole_mm, 12.0 * 0.25);
      EXPECT_NEAR(down_mm(now, inside), whole_mm, 0.05 * whole_mm) << z_mm << " " << edge.x;
      EXPECT_NEAR(down_mm(now, outside), 0.0, 1e-9) << z_mm << " " << edge.x;
      EXPECT_GT(down_mm(before, outside), 0.25 * whole_mm);
      // Out the wall goes as before.
      EXPECT_EQ(displaced(now, outside).y, displaced(before, outside).y);
      EXPECT_EQ(displaced(now, outside).x, outside.x);
    }
  // Spine, back and kidney are where the law of before has them (a kidney's way: Song 2011).
  for (const glm::dvec3& at : {glm::dvec3(0, 65, -60), {20, 108, -60}, {0, 47, 100}})
    EXPECT_LT(std::abs(down_mm(now, at)), 0.1) << at.y;
  for (const double side : {-1.0, 1.0})
    EXPECT_NEAR(down_mm(now, {side * 57.0, 35.0, -20.0}), down_mm(before, {side * 57.0, 35.0, -20.0}), 0.1);
}

// Along a funnel's wall everything keeps its share of the way to it: its own closed form.
TEST(CavityWall, IsNeverCrossed) {
  const CavityWall wall = funnel([](double z_mm) { return 120.0 + 0.3 * z_mm; });
  const BreathRegion region{.back_y_mm = 400.0, .depth_mm = 400.0};
  base::Rng rng(11);
  for (const double depth : {1.0, 3.0, -1.0}) {
    const glm::dvec3 only_down(0.0, 0.0, breath_mm(depth).z);
    const Displacement d = displacement_of({.breath = Breath{region, only_down, &wall}});
    for (int i = 0; i < 2000; ++i) {
      const double z_mm = 200.0 * rng.uniform() - 150.0, x = 2.0 * rng.uniform() - 1.0,
                   y = 2.0 * rng.uniform() - 1.0;
      const double share = rng.uniform() * 1.2, length = std::sqrt(x * x + y * y);
      const double radius = share * (120.0 + 0.3 * z_mm);
      const glm::dvec3 at(radius * x / length, radius * y / length, z_mm), to = displaced(d, at);
      ASSERT_NEAR(glm::length(glm::dvec2(to)) / (120.0 + 0.3 * to.z), share, 1e-6);
      ASSERT_NEAR(to.x * at.y, to.y * at.x, 1e-6);
      ASSERT_TRUE(share < 1.0 || to == at);
    }
  }
}

// However sharp the slip: nothing folds, and what has moved is found again.
TEST(CavityWall, FoldsNothingAndIsFoundAgain) {
  for (const volume::Body body : {volume::Body::adult, volume::Body::obese, volume::Body::child}) {
    const cases::Case scene = patient(body, true);
    const BreathRegion region = breath_region(scene).value();
    const CavityWall wall = cavity_wall(scene).value();
    const glm::dvec3 low(scene.skin.vertices_lps_mm[0]), high(scene.skin.vertices_lps_mm[1]);
    for (const double depth : {1.0, 3.0}) {
      const Displacement d = displacement_of({.breath = Breath{region, breath_mm(depth), &wall}});
      base::Rng rng(5);
      double least = 1.0, most_mm = 0.0, squares = 0.0;
      constexpr int kPlaces = 20000;
      for (int i = 0; i < kPlaces; ++i) {
        const glm::dvec3 at = low + (high - low) * glm::dvec3(rng.uniform(), rng.uniform(), rng.uniform());
        least = std::min(least, volume_ratio(d, at));
        const double miss_mm = glm::length(rest_of(d, displaced(d, at)) - at);
        most_mm = std::max(most_mm, miss_mm);
        squares += miss_mm * miss_mm;
      }
      EXPECT_GT(least, 0.5) << depth;
      EXPECT_LT(std::sqrt(squares / kPlaces), depth > 1.0 ? 0.05 : 0.001) << depth;
      EXPECT_LT(most_mm, depth > 1.0 ? 2.0 : 0.05) << depth;
    }
  }
}

// A picture's grid, through the wall at its steepest: a child's, whose deepest breath is an adult's.
TEST(CavityWall, APictureFindsWhatHasMovedFar) {
  const cases::Case scene = patient(volume::Body::child, true);
  const BreathRegion region = breath_region(scene).value();
  const CavityWall wall = cavity_wall(scene).value();
  const glm::dvec3 low(scene.skin.vertices_lps_mm[0]), size = glm::dvec3(scene.skin.vertices_lps_mm[1]) - low;
  for (const double depth : {1.0, 3.0}) {
    const Displacement d = displacement_of({.breath = Breath{region, breath_mm(depth), &wall}});
    EXPECT_EQ(picture_steps(d).newton, depth > 1.0 ? 4 : 1);
    double squares = 0.0, most_mm = 0.0;
    int n = 0;
    for (const bool coronal : {true, false})
      for (const double at : {0.3, 0.5, 0.7}) {
        PlanePart part{.first_lps_mm = low, .v = {0.0, 0.0, 1.0}, .size_mm = {size.x, size.z}};
        if (!coronal) {
          part.u = {0.0, 1.0, 0.0};
          part.size_mm.x = size.y;
        }
        part.first_lps_mm[coronal ? 1 : 0] += at * size[coronal ? 1 : 0];
        const RestPlane plane(d, part);
        for (double a = 0.7; a < part.size_mm.x; a += 1.9)
          for (double b = 0.7; b < part.size_mm.y; b += 1.9, ++n) {
            const glm::dvec3 here = part.first_lps_mm + a * part.u + b * part.v, exact = rest_of(d, here, {4, 12});
            ASSERT_LT(glm::length(displaced(d, exact) - here), 0.01);
            const double miss_mm = glm::length(plane.rest_of(a, b) - exact);
            squares += miss_mm * miss_mm;
            most_mm = std::max(most_mm, miss_mm);
          }
      }
    EXPECT_LT(std::sqrt(squares / n), 0.08) << depth;
    EXPECT_LT(most_mm, 0.6) << depth << ": with one of Newton's steps 1.8 of the deep one";
  }
}

// The wall lies in the same value that shaders are handed, and goes with it where presses are taken out.
TEST(CavityWall, GoesWithTheDisplacement) {
  const CavityWall wall = funnel([](double) { return 100.0; });
  const SkinPress press{.at_lps_mm = {0.0, -100.0, 0.0}, .inward = {0.0, 1.0, 0.0}, .depth_mm = 5.0};
  const Breath breath{{}, breath_mm(1.0), &wall};
  const Displacement both = displacement_of({.presses = {&press, 1}, .breath = breath}),
                     alone = displacement_of({.breath = breath});
  const glm::dvec3 at(30.0, -20.0, -40.0);
  EXPECT_EQ(displaced(without_presses(both), at), displaced(alone, at));
  EXPECT_NE(displaced(both, at), displaced(alone, at));
}

}  // namespace
}  // namespace seldinger::tissue
