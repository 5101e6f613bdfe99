// Tests of sim/haptics/proxy/surface_proxy. S8 … are rows of docs/touch.md.
#include "sim/haptics/proxy/surface_proxy.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "app/measure/rigs/surface_trials.h"
#include "sim/base/rng.h"
#include "tests/fixtures/allocations.h"
#include "tests/fixtures/meshes.h"

namespace seldinger::haptics {
namespace {

using measure::bumpy_sphere;
using measure::Crossings;
using measure::Glide;
using measure::glide;
using measure::sweep;

using cases::Mesh;
using cases::MeshIndex;

const MeshIndex& bumpy() {
  static const MeshIndex kIndex(bumpy_sphere(448, 224));
  return kIndex;
}

SurfaceSettings settings_of(double radius_mm, double friction) {
  return {.radius_mm = radius_mm, .static_friction = friction, .dynamic_friction = friction};
}

// A sheet at z = 0, 40 mm wide, of n by n squares.
Mesh sheet(int n, float z = 0.0F) {
  Mesh mesh;
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i)
      mesh.vertices_lps_mm.emplace_back(-20.0F + 40.0F * static_cast<float>(i) / static_cast<float>(n),
                                        -20.0F + 40.0F * static_cast<float>(j) / static_cast<float>(n), z);
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      const auto a = static_cast<unsigned>(j * (n + 1) + i), b = a + static_cast<unsigned>(n) + 1;
      mesh.triangles.emplace_back(a, a + 1, b);
      mesh.triangles.emplace_back(a + 1, b + 1, b);
    }
  return mesh;
}

void append(Mesh& mesh, const Mesh& other) {
  const auto first = static_cast<unsigned>(mesh.vertices_lps_mm.size());
  mesh.vertices_lps_mm.insert(mesh.vertices_lps_mm.end(), other.vertices_lps_mm.begin(),
                              other.vertices_lps_mm.end());
  for (const glm::uvec3& t : other.triangles) mesh.triangles.push_back(t + first);
}

// The device wanders above and far below a sheet, slowly and in jumps. On its side (z > 0) the proxy must stay, and
// whenever the device is well above, be there within 5 ticks.
void expect_kept_above(const Mesh& mesh, double radius_mm, double friction) {
  SCOPED_TRACE(testing::Message() << radius_mm << " mm, friction " << friction);
  const MeshIndex index(mesh);
  const SurfaceProxy proxy(settings_of(radius_mm, friction));
  SurfaceTrack track;
  base::Rng rng(5);
  glm::dvec3 device(0, 0, 5);
  proxy.advance(index, device, track);
  int below = 0;
  for (int leg = 0; leg < 60; ++leg) {
    const glm::dvec3 to(20.0 * rng.uniform() - 10.0, 20.0 * rng.uniform() - 10.0, leg % 2 == 0 ? -6.0 : 5.0);
    const int ticks = leg % 3 == 0 ? 1 : 10 + leg;  // 1: a jump
    const glm::dvec3 from = device;
    for (int tick = 1; tick <= ticks + 5; ++tick) {
      device = from + (to - from) * std::fmin(1.0, static_cast<double>(tick) / ticks);
      proxy.advance(index, device, track);
      ASSERT_GT(track.proxy_lps_mm.z, 0.0) << leg << " " << tick;
    }
    if (device.z > 0.0) {
      EXPECT_NEAR(glm::length(track.proxy_lps_mm - device), 0.0, 1e-6) << leg;
    } else {
      ++below;
    }
  }
  EXPECT_GT(below, 20);
}

TEST(SurfaceProxyS8, NothingStaysBehindOnABumpySphereOf200704Triangles) {
  for (const double radius_mm : {0.0, 1.0})
    for (const double friction : {0.0, 0.3}) {
      const Glide run = glide(bumpy(), settings_of(radius_mm, friction), 5000, 1);
      EXPECT_EQ(run.snags, 0) << radius_mm << " " << friction << ": " << run.most_mm;
      EXPECT_EQ(run.inside, 0) << radius_mm << " " << friction;
    }
}

TEST(SurfaceProxyS8, WithoutFrictionTheForceIsDepthAndAlongTheNormal) {
  const MeshIndex ball(fixtures::sphere_mesh({0, 0, 0}, 50.0, 6));
  for (const double radius_mm : {0.0, 1.0}) {
    const SurfaceProxy proxy(settings_of(radius_mm, 0.0));
    SurfaceTrack track;
    base::Rng rng(4);
    for (int i = 0; i < 200; ++i) {
      const glm::dvec3 out = glm::normalize(glm::dvec3(rng.normal(), rng.normal(), rng.normal()));
      track = {};
      proxy.advance(ball, out * 52.0, track);
      glm::dvec3 force_n(0.0);
      for (int tick = 0; tick < 200; ++tick) force_n = proxy.advance(ball, out * 48.0, track);
      const double expected_n = kProxySpring.stiffness_n_mm * (2.0 + proxy.radius_mm());
      EXPECT_NEAR(glm::length(force_n), expected_n, 0.03 * expected_n);
      EXPECT_GT(glm::dot(glm::normalize(force_n), out), std::cos(0.03));
    }
  }
}

TEST(SurfaceProxyS9, BadMeshesAreNeverCrossedAndNothingSticks) {
  Mesh flipped = sheet(9);
  for (std::size_t t = 0; t < flipped.triangles.size(); t += 3)
    std::swap(flipped.triangles[t].x, flipped.triangles[t].y);
  Mesh twice = sheet(9);
  append(twice, sheet(9));
  Mesh junctions = sheet(3);  // edges that meet others in their middle
  append(junctions, sheet(8));
  Mesh thin = sheet(9);  // with triangles of no area, across and along
  for (unsigned v = 0; v + 11 < thin.vertices_lps_mm.size(); v += 7) {
    thin.triangles.emplace_back(v, v, v);
    thin.triangles.emplace_back(v, v + 11, v);
    thin.triangles.emplace_back(v, v + 1, v + 2);
  }
  Mesh slivers = sheet(9);  // three faces on an edge: walls of a hundredth of a micron below
  const auto count = slivers.triangles.size();
  for (std::size_t t = 0; t < count; t += 2) {
    const glm::uvec3 v = slivers.triangles[t];
    slivers.vertices_lps_mm.push_back(slivers.vertices_lps_mm[v.x] + glm::vec3(0, 0, -1e-5F));
    slivers.triangles.emplace_back(v.x, v.y, static_cast<unsigned>(slivers.vertices_lps_mm.size()) - 1);
  }
  const Mesh meshes[] = {sheet(1), sheet(40), flipped, twice, junctions, thin, slivers};
  for (std::size_t i = 0; i < std::size(meshes); ++i) {
    SCOPED_TRACE(i);
    for (const double radius_mm : {0.0, 1.0})
      for (const double friction : {0.0, 0.3}) expect_kept_above(meshes[i], radius_mm, friction);
  }
}

TEST(SurfaceProxyS9, OneMillimetreBetweenTwoWallsIsKept) {
  Mesh walls = sheet(6);
  append(walls, sheet(5, 1.0F));
  const MeshIndex index(walls);
  for (const double radius_mm : {0.0, 0.4, 1.0}) {  // the last does not even fit
    const SurfaceProxy proxy(settings_of(radius_mm, 0.0));
    SurfaceTrack track;
    proxy.advance(index, {0, 0, 0.5}, track);
    for (int tick = 0; tick < 400; ++tick) {
      const double z = 0.5 + (tick / 50 % 2 == 0 ? 5.0 : -5.0);
      proxy.advance(index, {0.02 * tick, 0.0, z}, track);
      ASSERT_GT(track.proxy_lps_mm.z, 0.0) << radius_mm << " " << tick;
      ASSERT_LT(track.proxy_lps_mm.z, 1.0) << radius_mm << " " << tick;
    }
  }
}

TEST(SurfaceProxyS9, AFoldAsThinAsANeedleIsAWall) {
  Mesh fold;  // 6 mm high, 10 microns wide at its foot
  fold.vertices_lps_mm = {{-0.005F, -30, -3}, {-0.005F, 30, -3}, {0, -30, 3},
                          {0, 30, 3},         {0.005F, -30, -3}, {0.005F, 30, -3}};
  fold.triangles = {{0, 2, 1}, {1, 2, 3}, {2, 4, 3}, {3, 4, 5}};
  const MeshIndex index(fold);
  for (const double radius_mm : {0.0, 1.0}) {
    const SurfaceProxy proxy(settings_of(radius_mm, 0.1));
    SurfaceTrack track;
    for (int tick = 0; tick < 600; ++tick) {
      const double x = 4.0 * std::cos(0.05 * tick), z = 1.5 * std::sin(0.013 * tick);
      proxy.advance(index, {x, 3.0 * std::sin(0.02 * tick), z}, track);
      ASSERT_GT(track.proxy_lps_mm.x, 0.0) << tick;
    }
  }
}

TEST(SurfaceProxyS10, NothingIsCrossedUpTo2MetresASecondNorByAJump) {
  for (const double radius_mm : {0.0, 1.0}) {
    const Crossings run = sweep(bumpy(), settings_of(radius_mm, 0.3), 1000, 2);
    EXPECT_EQ(run.sweeps, 1000);
    EXPECT_EQ(run.inside, 0);
    EXPECT_EQ(run.untouched, 0);
  }
}

TEST(SurfaceProxyS15, TwoHandsFeelWhatEachFeelsAloneAndGainNoEnergy) {
  const MeshIndex index(fixtures::sphere_mesh({0, 0, 0}, 30.0, 4, 1.0));
  for (const double friction : {0.0, 0.3}) {
    const SurfaceProxy probe(settings_of(1.0, friction)), needle(settings_of(0.0, friction));
    SurfaceTrack tracks[2], alone;
    glm::dvec3 last[2], last_n[2];
    double given_mj = 0.0, least_mj = 0.0;  // N mm
    for (int tick = 0; tick < 4000; ++tick) {
      const double turn = 6.283185307179586 * tick / 1000.0;  // closed ways, in and out
      const glm::dvec3 way(std::cos(turn), std::sin(turn), 0.3 * std::sin(2.0 * turn));
      const double radius = 30.0 + 4.0 * std::cos(7.0 * turn);
      for (int hand = 0; hand < 2; ++hand) {
        const SurfaceProxy& proxy = hand == 0 ? probe : needle;
        const glm::dvec3 at = glm::normalize(hand == 0 ? way : glm::dvec3(way.z, way.x, way.y)) * radius;
        const glm::dvec3 force_n = proxy.advance(index, at, tracks[hand]);
        // By the mean of both ends: what a sampled force adds is the wall map's matter (S2).
        if (tick > 0) given_mj += glm::dot(0.5 * (force_n + last_n[hand]), at - last[hand]);
        last[hand] = at;
        last_n[hand] = force_n;
        if (hand == 1) {
          EXPECT_EQ(needle.advance(index, at, alone), force_n);
        }
      }
      least_mj = std::fmax(least_mj, given_mj);
    }
    EXPECT_LE(least_mj, 1.0) << friction;
    if (friction > 0.0) {
      EXPECT_LT(given_mj, -5.0);
    }
  }
}

TEST(SurfaceProxy, StaticFrictionHoldsAndDynamicFrictionDrags) {
  const MeshIndex index(sheet(7));
  const SurfaceProxy proxy({.static_friction = 0.5, .dynamic_friction = 0.3});
  SurfaceTrack track;
  proxy.advance(index, {0, 0, 1}, track);
  proxy.advance(index, {0, 0, -1}, track);
  proxy.advance(index, {0, 0, -1}, track);
  const double pressed = 1.0 + proxy.radius_mm();
  proxy.advance(index, {0.49 * pressed, 0, -1}, track);
  EXPECT_NEAR(track.proxy_lps_mm.x, 0.0, 1e-9);
  EXPECT_TRUE(track.holding);
  proxy.advance(index, {0.52 * pressed, 0, -1}, track);
  EXPECT_NEAR(track.proxy_lps_mm.x, 0.22 * pressed, 1e-6);
  for (int i = 0; i < 20; ++i) proxy.advance(index, {0.52 * pressed + 0.1 * i, 0, -1}, track);
  EXPECT_NEAR(track.proxy_lps_mm.x, 0.22 * pressed + 1.9, 1e-6);  // sliding goes on by the dynamic one
  proxy.advance(index, {0.52 * pressed + 1.9, 0, -1}, track);
  EXPECT_TRUE(track.holding);
}

TEST(SurfaceProxy, ACornerIsReachedInOneTick) {
  const MeshIndex room(fixtures::box_mesh({-10, -10, -10}, {10, 10, 10}));
  for (const double radius_mm : {0.0, 1.0}) {
    const SurfaceProxy proxy(settings_of(radius_mm, 0.0));
    SurfaceTrack track;
    proxy.advance(room, {0, 1, 2}, track);
    proxy.advance(room, {14, 15, -13}, track);
    const double side = 10.0 - proxy.radius_mm();
    EXPECT_NEAR(glm::length(track.proxy_lps_mm - glm::dvec3(side, side, -side)), 0.0, 0.01);
  }
}

TEST(SurfaceProxy, NeitherAllocatesNorFollowsADeviceThatIsNowhere) {
  const MeshIndex index(sheet(7));
  const SurfaceProxy proxy(settings_of(1.0, 0.3));
  SurfaceTrack track;
  proxy.advance(index, {0, 0, 3}, track);
  const auto before = fixtures::allocations();
  for (int i = 0; i < 100; ++i) proxy.advance(index, {0.1 * i, 0, 3 - 0.1 * i}, track);
  EXPECT_EQ(fixtures::allocations(), before);
  const glm::dvec3 kept = track.proxy_lps_mm;
  const double nan = std::numeric_limits<double>::quiet_NaN(), far = std::numeric_limits<double>::infinity();
  EXPECT_EQ(proxy.advance(index, {nan, 0, 0}, track), glm::dvec3(0.0));
  EXPECT_EQ(proxy.advance(index, {0, far, 0}, track), glm::dvec3(0.0));
  EXPECT_EQ(track.proxy_lps_mm, kept);
  SurfaceTrack none;
  EXPECT_EQ(proxy.advance(MeshIndex(), {1, 2, 3}, none), glm::dvec3(0.0));
}

}  // namespace
}  // namespace seldinger::haptics
