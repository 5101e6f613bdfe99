// Tests of sim/haptics/proxy/volume_proxy and iso_surface. S7 … are rows of docs/touch.md.
#include "sim/haptics/proxy/volume_proxy.h"

#include <gtest/gtest.h>

#include <cmath>

#include "app/measure/rigs/volume_trials.h"
#include "sim/base/rng.h"
#include "tests/fixtures/allocations.h"

namespace seldinger::haptics {
namespace {

using measure::ct_of;
using measure::Slide;
using measure::slide;
using measure::Solid;
using measure::SolidInCt;

TEST(VolumeProxyS7, SlidesOnABallACylinderAndAPlaneWithoutSteps) {
  for (const Solid shape : {Solid::ball, Solid::cylinder, Solid::plane})
    for (const double noise_hu : {0.0, 10.0, 30.0})
      for (const bool bone : {false, true}) {
        SCOPED_TRACE(testing::Message() << static_cast<int>(shape) << ", " << noise_hu << " HU, bone " << bone);
        SolidInCt solid{.shape = shape, .noise_hu = noise_hu};
        if (bone) {
          solid.outside_hu = 40.0;
          solid.inside_hu = 700.0;
        }
        const Slide run = slide(solid, ct_of(solid, 3), {}, 4000, 1);
        EXPECT_LE(run.direction_rms_deg, 3.5);
        EXPECT_LE(run.most_step_n, 0.03);
        EXPECT_NEAR(run.force_off, 0.0, 0.03);
        EXPECT_EQ(run.lost, 0);
      }
}

// Symmetric kernels keep straight lines: in an oblique, left-handed volume too.
TEST(IsoSurface, IsExactOnALinearField) {
  const glm::dmat3 direction(glm::dvec3(0.6, 0.8, 0.0), glm::dvec3(0.8, -0.6, 0.0), glm::dvec3(0, 0, 1));
  volume::Volume ct = volume::make_volume(glm::ivec3(14, 12, 10), {0.7, 0.9, 2.0}, direction, {5, -7, 11});
  for (int k = 0; k < 10; ++k)
    for (int j = 0; j < 12; ++j)
      for (int i = 0; i < 14; ++i) ct.hu[ct.index(i, j, k)] = static_cast<std::int16_t>(20 * i - 11 * j + 7 * k);
  const IsoSurface surface(ct, 100.0);
  base::Rng rng(1);
  for (int n = 0; n < 200; ++n) {
    const glm::dvec3 index(3.0 + 7.0 * rng.uniform(), 3.0 + 5.0 * rng.uniform(), 3.0 + 3.0 * rng.uniform());
    const glm::dvec3 p(ct.lps_from_voxel * glm::dvec4(index, 1.0));
    const IsoSurface::Value value = surface.at(p);
    EXPECT_NEAR(value.hu, 20.0 * index.x - 11.0 * index.y + 7.0 * index.z - 100.0, 1e-9);
    const glm::dvec3 rise = direction * glm::dvec3(20.0 / 0.7, -11.0 / 0.9, 7.0 / 2.0);
    EXPECT_NEAR(glm::length(value.rise_hu_mm - rise), 0.0, 1e-9);
  }
  EXPECT_EQ(surface.at({1e4, 0, 0}).hu, volume::kAirHu - 100.0);
}

TEST(IsoSurface, RiseIsTheSlopeOfItsValueUpToTheVolumesEnd) {
  const SolidInCt solid{.radius_mm = 6.0};
  const volume::Volume ct = ct_of(solid, 8);
  const IsoSurface surface(ct, solid.iso_hu());
  base::Rng rng(2);
  for (int n = 0; n < 300; ++n) {
    const glm::dvec3 p = (glm::dvec3(rng.uniform(), rng.uniform(), rng.uniform()) - 0.5) * 32.0;
    for (int axis = 0; axis < 3; ++axis) {
      glm::dvec3 step(0.0);
      step[axis] = 1e-4;
      EXPECT_NEAR((surface.at(p + step).hu - surface.at(p - step).hu) / 2e-4, surface.at(p).rise_hu_mm[axis], 0.05);
    }
  }
}

TEST(VolumeProxyS10, StaysOutsideAtAnySpeedAndAfterAJump) {
  const SolidInCt solid{.radius_mm = 12.0};
  const volume::Volume ct = ct_of(solid, 4);
  const IsoSurface surface(ct, solid.iso_hu());
  const VolumeProxy proxy({.static_friction = 0.2, .dynamic_friction = 0.1});
  base::Rng rng(6);
  const auto direction = [&] { return glm::normalize(glm::dvec3(rng.normal(), rng.normal(), rng.normal())); };
  for (int i = 0; i < 300; ++i) {
    const glm::dvec3 from = direction() * 14.0, side = direction() * 8.0;
    const glm::dvec3 to = glm::dot(from, side) < 0.0 ? -side : side;
    const double share = i % 4 == 0 ? 1.0 : 0.02 + 0.2 * rng.uniform();  // of the way, a tick
    VolumeProxyTrack track;
    glm::dvec3 force_n(0.0);
    proxy.advance(surface, from, track);
    for (int tick = 1; tick <= 60; ++tick) {
      force_n = proxy.advance(surface, from + (to - from) * std::fmin(1.0, share * tick), track);
      ASSERT_LT(surface.at(track.proxy_lps_mm).hu, 0.0) << i;
    }
    ASSERT_GT(glm::length(force_n), 0.5) << i;
    for (int tick = 0; tick < 5; ++tick) proxy.advance(surface, 2.0 * to, track);  // and comes off again
    EXPECT_EQ(track.proxy_lps_mm, 2.0 * to);
  }
}

TEST(VolumeProxy, FrictionHoldsUpToItsShareOfWhatPresses) {
  const SolidInCt solid{.shape = Solid::plane, .noise_hu = 0.0};
  const volume::Volume ct = ct_of(solid, 1);
  const IsoSurface surface(ct, solid.iso_hu());
  const VolumeProxy proxy({.static_friction = 0.5, .dynamic_friction = 0.3});
  const glm::dvec3 up(1.0 / 3.0, 2.0 / 3.0, 2.0 / 3.0), side = glm::normalize(glm::cross(up, glm::dvec3(1, 0, 0)));
  VolumeProxyTrack track;
  proxy.advance(surface, up * 2.0, track);
  proxy.advance(surface, -2.0 * up, track);
  proxy.advance(surface, -2.0 * up, track);
  proxy.advance(surface, -2.0 * up + 0.9 * side, track);
  EXPECT_NEAR(glm::dot(track.proxy_lps_mm, side), 0.0, 0.05);
  EXPECT_TRUE(track.holding);
  proxy.advance(surface, -2.0 * up + 1.2 * side, track);
  EXPECT_NEAR(glm::dot(track.proxy_lps_mm, side), 0.6, 0.05);
}

TEST(VolumeProxy, StartedInsideItGoesWithTheDeviceUntilThatIsOut) {
  const SolidInCt solid{.radius_mm = 8.0};
  const volume::Volume ct = ct_of(solid, 2);
  const IsoSurface surface(ct, solid.iso_hu());
  const VolumeProxy proxy({});
  VolumeProxyTrack track;
  for (int i = 0; i <= 100; ++i) {
    EXPECT_EQ(proxy.advance(surface, {0.1 * i, 0, 0}, track), glm::dvec3(0.0));
  }
  const auto before = fixtures::allocations();
  glm::dvec3 force_n(0.0);
  for (int i = 0; i <= 40; ++i) force_n = proxy.advance(surface, {10.0 - 0.1 * i, 0, 0}, track);
  EXPECT_EQ(fixtures::allocations(), before);
  EXPECT_GT(force_n.x, 0.5);
  EXPECT_EQ(proxy.advance(surface, {std::nan(""), 0, 0}, track), glm::dvec3(0.0));
}

}  // namespace
}  // namespace seldinger::haptics
