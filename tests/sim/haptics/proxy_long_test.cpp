// The counts of S8 and S10 of docs/touch.md in full.
#include <gtest/gtest.h>

#include "app/measure/rigs/surface_trials.h"

namespace seldinger::haptics {
namespace {

using measure::bumpy_sphere;
using measure::Crossings;
using measure::Glide;
using measure::glide;
using measure::sweep;

TEST(SurfaceProxyLong, AMillionTicksWithoutASnagAndAHundredThousandSweepsWithoutACrossing) {
  const cases::MeshIndex mesh(bumpy_sphere(448, 224));
  for (const double radius_mm : {0.0, 1.0})
    for (const double friction : {0.0, 0.3}) {
      SCOPED_TRACE(testing::Message() << radius_mm << " mm, friction " << friction);
      const SurfaceSettings settings{
          .radius_mm = radius_mm, .static_friction = friction, .dynamic_friction = 0.8 * friction};
      const Glide run = glide(mesh, settings, 1000000, 1);
      EXPECT_EQ(run.snags, 0) << run.most_mm;
      EXPECT_EQ(run.inside, 0);
      const Crossings crossings = sweep(mesh, settings, 100000, 2);
      EXPECT_EQ(crossings.inside, 0);
      EXPECT_EQ(crossings.untouched, 0);
    }
}

}  // namespace
}  // namespace seldinger::haptics
