// Tests of sim/haptics/needle/needle_path: the layers of a body wall with an organ, told from voxels.
#include "sim/haptics/needle/needle_path.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <string>

#include "tests/fixtures/allocations.h"

namespace seldinger::haptics {
namespace {

using volume::TissueClass;

// A body below z = 0, layered along z; voxels of 1 × 1 × 0.8 mm, centres within the layers.
struct Body {
  volume::Volume volume;
  std::vector<TissueClass> classes;
  Body() {
    volume = volume::make_volume({40, 40, 140}, {1.0, 1.0, 0.8}, glm::dmat3(1.0), {-20.0, -20.0, -110.0});
    classes.resize(volume.hu.size());
    for (int k = 0; k < 140; ++k) {
      const double deep_mm = 110.0 - 0.8 * k;
      for (int j = 0; j < 40; ++j)
        for (int i = 0; i < 40; ++i) classes[volume.index(i, j, k)] = of_depth(deep_mm);
    }
  }
  static TissueClass of_depth(double deep_mm) {
    return deep_mm < 0.0    ? TissueClass::air
           : deep_mm < 14.0 ? TissueClass::fat
           : deep_mm < 30.0 ? TissueClass::muscle
           : deep_mm < 70.0 ? TissueClass::kidney
           : deep_mm < 90.0 ? TissueClass::fat
                            : TissueClass::bone;
  }
  void fleck(double from_mm, double to_mm, TissueClass tissue) {
    for (int k = 0; k < 140; ++k) {
      const double deep_mm = 110.0 - 0.8 * k;
      if (deep_mm < from_mm || deep_mm > to_mm) continue;
      for (int j = 0; j < 40; ++j)
        for (int i = 0; i < 40; ++i) classes[volume.index(i, j, k)] = tissue;
    }
  }
};

const cases::Gauge kGauge = *cases::gauge(22);
const glm::dvec3 kDown(0.0, 0.0, -1.0);

void expect_layers(const NeedlePath& path, const std::vector<std::pair<double, TissueClass>>& expected) {
  ASSERT_EQ(path.count, expected.size());
  for (std::size_t i = 0; i < path.count; ++i) {
    EXPECT_NEAR(path.layers[i].start_mm, expected[i].first, 0.9) << i;
    EXPECT_EQ(path.tissues[i], expected[i].second) << i;
    EXPECT_EQ(path.layers[i].tissue.rupture_n, needle_tissue(expected[i].second).rupture_n) << i;
  }
}

TEST(NeedlePath, TellsTheBodysLayers) {
  const Body body;
  const TissueAlongNeedle tissue(body.volume, body.classes, kGauge);
  NeedlePath path;
  tissue.look({0.3, 0.2, 0.0}, kDown, 150.0, -5.0, {}, path);
  expect_layers(path, {{0.0, TissueClass::skin},
                       {2.0, TissueClass::fat},
                       {14.0, TissueClass::muscle},
                       {30.0, TissueClass::kidney},
                       {70.0, TissueClass::fat},
                       {90.0, TissueClass::bone},
                       {110.0, TissueClass::air}});
  // Obliquely they are longer.
  NeedlePath oblique;
  tissue.look({-15.0, 0.2, 0.0}, glm::normalize(glm::dvec3(0.5, 0.0, -1.0)), 40.0, -5.0, {}, oblique);
  ASSERT_GE(oblique.count, 4U);
  EXPECT_NEAR(oblique.layers[3].start_mm, 30.0 * std::sqrt(1.25), 1.2);
}

TEST(NeedlePath, FlecksAreNoLayersButBoneIs) {
  Body body;
  body.fleck(20.0, 21.0, TissueClass::vessel);
  body.fleck(50.0, 53.5, TissueClass::fluid);
  body.fleck(60.0, 60.7, TissueClass::bone);
  const TissueAlongNeedle tissue(body.volume, body.classes, kGauge);
  NeedlePath path;
  tissue.look({0.3, 0.2, 0.0}, kDown, 65.0, -5.0, {}, path);
  expect_layers(path, {{0.0, TissueClass::skin},
                       {2.0, TissueClass::fat},
                       {14.0, TissueClass::muscle},
                       {30.0, TissueClass::kidney},
                       {50.0, TissueClass::fluid},
                       {53.5, TissueClass::kidney},
                       {60.0, TissueClass::bone},
                       {61.0, TissueClass::kidney}});
}

// What the tip has touched does not move when the line does; what lies ahead may.
TEST(NeedlePath, KeepsWhatIsEnteredOrTouched) {
  Body near, far;
  far.fleck(30.0, 34.0, TissueClass::muscle);
  const TissueAlongNeedle in_near(near.volume, near.classes, kGauge), in_far(far.volume, far.classes, kGauge);
  const NeedleLaw law({});
  NeedleTrack track;
  NeedlePath path;
  double depth = -2.0, last = 0.0;
  for (; depth < 17.0; depth += 0.01) {
    in_near.look({0.3, 0.2, 0.0}, kDown, 120.0, depth, track, path);
    last = law.advance(path.span(), depth, track).axial_n;
  }
  EXPECT_EQ(track.opened, 2U) << "in fat, the muscle's fascia dented";
  in_far.look({0.3, 0.2, 0.0}, kDown, 120.0, depth, track, path);
  EXPECT_NEAR(path.layers[2].start_mm, 14.0, 0.9);
  EXPECT_NEAR(path.layers[3].start_mm, 34.0, 0.9) << "the kidney moved on";
  EXPECT_NEAR(law.advance(path.span(), depth, track).axial_n, last, 0.02);
}

// Any wandering of hand and line: no step but at what opens, no allocation.
TEST(NeedlePath, ATremblingLineIsNoStep) {
  Body body;
  body.fleck(40.0, 46.0, TissueClass::fluid);
  const TissueAlongNeedle tissue(body.volume, body.classes, kGauge);
  const NeedleLaw law({});
  NeedleTrack track;
  NeedlePath path;
  double last = 0.0;
  const long before = fixtures::allocations();
  int steps = 0, opened = 0;
  for (int i = 0; i < 20000; ++i) {
    const double depth = -2.0 + 0.004 * i + 0.5 * std::sin(0.01 * i);
    const glm::dvec3 direction =
        glm::normalize(glm::dvec3(0.02 * std::sin(0.013 * i), 0.02 * std::cos(0.007 * i), -1.0));
    tissue.look({0.3 + 0.5 * std::sin(0.005 * i), 0.2, 0.2 * std::sin(0.011 * i)}, direction, 120.0, depth, track,
                path);
    const NeedleForce force = law.advance(path.span(), depth, track);
    if (force.ruptured) ++opened;
    if (!force.ruptured && std::abs(force.falling_n) < 0.05 && std::abs(force.axial_n - last) > 0.15) ++steps;
    last = force.axial_n;
  }
  EXPECT_EQ(fixtures::allocations(), before);
  EXPECT_EQ(steps, 0);
  EXPECT_GE(opened, 5) << "skin, fat, muscle, kidney, fluid";
}

TEST(NeedlePath, NeverHoldsMoreThanItCan) {
  Body body;
  for (int k = 0; k < 140; ++k)
    for (int j = 0; j < 40; ++j)
      for (int i = 0; i < 40; ++i)
        body.classes[body.volume.index(i, j, k)] = (k / 4) % 2 == 0 ? TissueClass::fat : TissueClass::muscle;
  const TissueAlongNeedle tissue(body.volume, body.classes, kGauge);
  NeedlePath path;
  tissue.look({0.3, 0.2, 0.0}, kDown, 150.0, -1.0, {}, path);
  EXPECT_EQ(path.count, kMostNeedleLayers);
  for (std::size_t i = 1; i < path.count; ++i) EXPECT_GT(path.layers[i].start_mm, path.layers[i - 1].start_mm);
}

TEST(NeedlePath, SoftTissueGetsTheRowOfItsHu) {
  Body body;
  body.fleck(40.0, 60.0, TissueClass::soft_tissue);
  std::fill(body.volume.hu.begin(), body.volume.hu.end(), std::int16_t{5});
  const TissueAlongNeedle tissue(body.volume, body.classes, *cases::gauge(18));
  NeedlePath path;
  tissue.look({0.3, 0.2, 0.0}, kDown, 80.0, -1.0, {}, path);
  ASSERT_EQ(path.tissues[4], TissueClass::soft_tissue);
  EXPECT_NEAR(path.layers[4].tissue.intercept_n, soft_tissue_of_hu(5.0).intercept_n * 1.270 / 0.718, 1e-12);
  EXPECT_NE(soft_tissue_of_hu(5.0).intercept_n, needle_tissue(TissueClass::soft_tissue).intercept_n);
  // Entered, it keeps it.
  std::fill(body.volume.hu.begin(), body.volume.hu.end(), std::int16_t{60});
  NeedleTrack track;
  track.opened = 5;
  track.cut_mm = 45.0;
  tissue.look({0.3, 0.2, 0.0}, kDown, 80.0, 50.0, track, path);
  EXPECT_NEAR(path.layers[4].tissue.intercept_n, soft_tissue_of_hu(5.0).intercept_n * 1.270 / 0.718, 1e-12);
}

TEST(NeedlePath, AThickerNeedleGetsItsRows) {
  const Body body;
  NeedlePath path;
  TissueAlongNeedle(body.volume, body.classes, *cases::gauge(18))
      .look({0.3, 0.2, 0.0}, kDown, 50.0, -1.0, {}, path);
  EXPECT_NEAR(path.layers[1].tissue.intercept_n, 0.15 * 1.270 / 0.718, 1e-12);
}

}  // namespace
}  // namespace seldinger::haptics
