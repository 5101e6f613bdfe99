// Columns turned into a tile's frame say what the slab says, anywhere in their box and at its borders.
#include "sim/imaging/ultrasound/speckle/turned_columns.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "sim/base/rng.h"
#include "sim/tissue/displacement.h"

namespace seldinger::imaging {
namespace {

TEST(TurnedColumns, SayWhatTheSlabSays) {
  const tissue::SkinPress press{.at_lps_mm = {0, 0, 0}, .inward = {0, 0, 1}, .radius_mm = 20.0, .depth_mm = 8.0};
  tissue::SlabPart part;
  part.normal = glm::normalize(glm::dvec3(0.2, -0.1, 0.9));
  part.low_mm = {-30.0, -40.0, 5.0};
  part.high_mm = {30.0, 40.0, 35.0};
  const tissue::MovedSlab slab(tissue::displacement_of({.presses = {&press, 1}}), part);
  const glm::dvec3 x = glm::normalize(glm::dvec3(1.0, 0.4, -0.3)),
                   y = glm::normalize(glm::cross(x, glm::dvec3(0.1, 0.2, 1.0))), z = glm::cross(x, y);
  const glm::vec3 axes[3] = {glm::vec3(x), glm::vec3(y), glm::vec3(z)};
  constexpr int kFirst = 2, kLayers = 5;
  const glm::dvec2 low(-7.3, 4.1), high(9.6, 28.0);
  TurnedColumns columns;
  columns.turn(slab, axes, low, high, kFirst, kLayers);
  base::Rng rng(7);
  for (int i = 0; i < 2000; ++i) {
    // Its corners first.
    const double along = i < 4 ? i % 2 : rng.uniform(), down = i < 4 ? i / 2 : rng.uniform();
    const double x_mm = low.x + along * (high.x - low.x), y_mm = low.y + down * (high.y - low.y);
    columns.go_to(x_mm);
    float mm[kLayers][4];
    columns.lay(y_mm, mm);
    for (int l = 0; l < kLayers; ++l) {
      const double height_mm = part.low_mm.z + (kFirst + l) * part.layer_mm;
      const glm::dvec3 flat(x_mm, y_mm, 0.0),
          rest(x_mm, y_mm, (height_mm - glm::dot(part.normal, flat)) / part.normal.z), u = slab.moved_mm(rest);
      const glm::dvec3 turned(glm::dot(u, x), glm::dot(u, y), glm::dot(u, z));
      ASSERT_LT(glm::length(glm::dvec3(mm[l][0], mm[l][1], mm[l][2]) - turned), 1e-4) << x_mm << " " << y_mm;
      ASSERT_GT(glm::length(u), 1e-3) << "it moves there";
    }
  }
}

}  // namespace
}  // namespace seldinger::imaging
