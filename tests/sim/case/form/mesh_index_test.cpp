// Tests of sim/case/form/mesh_index and sim/case/form/mesh.
#include "sim/case/form/mesh_index.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "sim/base/rng.h"
#include "tests/fixtures/meshes.h"

namespace seldinger::cases {
namespace {

glm::dvec3 point_within(base::Rng& rng, double half_mm) {
  return (glm::dvec3(rng.uniform(), rng.uniform(), rng.uniform()) - 0.5) * (2.0 * half_mm);
}

// Nearest point by a plain way that shares nothing with the index: projection, then edges, then corners.
double brute_distance(const Mesh& mesh, const glm::dvec3& p) {
  double best = std::numeric_limits<double>::infinity();
  for (const glm::uvec3& t : mesh.triangles) {
    const glm::dvec3 v[3] = {glm::dvec3(mesh.vertices_lps_mm[t.x]), glm::dvec3(mesh.vertices_lps_mm[t.y]),
                             glm::dvec3(mesh.vertices_lps_mm[t.z])};
    const glm::dvec3 n = glm::normalize(glm::cross(v[1] - v[0], v[2] - v[0]));
    const glm::dvec3 q = p - n * glm::dot(p - v[0], n);
    bool inside = true;
    for (int i = 0; i < 3; ++i) {
      const glm::dvec3 edge = v[(i + 1) % 3] - v[i];
      inside = inside && glm::dot(glm::cross(edge, q - v[i]), n) >= 0.0;
      const double s = std::fmin(1.0, std::fmax(0.0, glm::dot(p - v[i], edge) / glm::dot(edge, edge)));
      best = std::fmin(best, glm::length(p - (v[i] + edge * s)));
    }
    if (inside) best = std::fmin(best, glm::length(p - q));
  }
  return best;
}

TEST(MeshIndex, ClosestEqualsBruteForceOnAConcaveSurface) {
  const Mesh mesh = fixtures::sphere_mesh({3, -2, 5}, 40.0, 4, 4.0);
  const MeshIndex index(mesh);
  base::Rng rng(1);
  std::uint32_t hint = 0;
  for (int i = 0; i < 2000; ++i) {
    const glm::dvec3 p = point_within(rng, 60.0);
    const Closest closest = index.closest(p, hint);
    EXPECT_NEAR(std::abs(closest.distance_mm), brute_distance(mesh, p), 1e-9);
    EXPECT_NEAR(glm::length(p - closest.point_lps_mm), std::abs(closest.distance_mm), 1e-9);
    hint = closest.triangle;
  }
}

TEST(MeshIndex, AHintNeverChangesTheAnswer) {
  const Mesh mesh = fixtures::sphere_mesh({0, 0, 0}, 40.0, 3, 4.0);
  const MeshIndex index(mesh);
  base::Rng rng(2);
  for (int i = 0; i < 1000; ++i) {
    // Lattice points make ties between triangles common.
    const glm::dvec3 p = glm::floor(point_within(rng, 50.0) / 10.0) * 10.0;
    const Closest plain = index.closest(p);
    const Closest hinted = index.closest(p, static_cast<std::uint32_t>(rng.bits() % mesh.triangles.size()));
    EXPECT_EQ(plain.distance_mm, hinted.distance_mm);
    EXPECT_EQ(plain.triangle, hinted.triangle);
    EXPECT_EQ(plain.point_lps_mm, hinted.point_lps_mm);
  }
}

TEST(MeshIndex, SignIsThatOfTheWindingNumber) {
  const Mesh mesh = fixtures::sphere_mesh({0, 0, 0}, 40.0, 4, 5.0);
  const MeshIndex index(mesh);
  base::Rng rng(3);
  for (int i = 0; i < 1000; ++i) {
    const glm::dvec3 p = point_within(rng, 50.0);
    double solid_angle = 0.0;  // Van Oosterom and Strackee, IEEE Trans. Biomed. Eng. 30, 1983
    for (const glm::uvec3& t : mesh.triangles) {
      const glm::dvec3 a = glm::dvec3(mesh.vertices_lps_mm[t.x]) - p, b = glm::dvec3(mesh.vertices_lps_mm[t.y]) - p,
                       c = glm::dvec3(mesh.vertices_lps_mm[t.z]) - p;
      const double la = glm::length(a), lb = glm::length(b), lc = glm::length(c);
      solid_angle += 2.0 * std::atan2(glm::dot(a, glm::cross(b, c)), la * lb * lc + glm::dot(a, b) * lc +
                                                                         glm::dot(b, c) * la + glm::dot(c, a) * lb);
    }
    EXPECT_EQ(index.closest(p).distance_mm<0.0, solid_angle> 6.0) << glm::length(p);
  }
}

TEST(MeshIndex, SignIsRightBesideEdgesAndCorners) {
  const MeshIndex index(fixtures::box_mesh({-1, -1, -1}, {1, 1, 1}));
  for (const double s : {-1.0, 1.0}) {
    EXPECT_NEAR(index.closest({1.5 * s, 1.5 * s, 1.5 * s}).distance_mm, std::sqrt(0.75), 1e-12);
    EXPECT_NEAR(index.closest({1.5 * s, 1.5 * s, 0.1}).distance_mm, std::sqrt(0.5), 1e-12);
    EXPECT_NEAR(index.closest({0.9 * s, 0.9 * s, 0.9 * s}).distance_mm, -0.1, 1e-7);
  }
}

TEST(MeshIndex, SkinLeavesOutCutCapsAndKeepsTheSign) {
  const MeshIndex index(fixtures::box_mesh({-10, -20, -30}, {10, 20, 30}, true));
  const Closest near_cap = index.closest_skin({0, 0, 29});
  EXPECT_NEAR(near_cap.distance_mm, -10.0, 1e-6);
  EXPECT_NEAR(index.closest_skin({0, 0, 31}).distance_mm, std::sqrt(101.0), 1e-6);
  EXPECT_NEAR(index.closest({0, 0, 29}).distance_mm, -1.0, 1e-6);
}

TEST(MeshIndex, RaysHitASphereWhereTheyShould) {
  const MeshIndex index(fixtures::sphere_mesh({0, 0, 0}, 50.0, 6));
  base::Rng rng(4);
  for (int i = 0; i < 500; ++i) {
    const glm::dvec3 p = point_within(rng, 25.0);
    const glm::dvec3 d = glm::normalize(point_within(rng, 1.0));
    const double b = glm::dot(p, d), c = glm::dot(p, p) - 2500.0;
    const auto hit = index.first_hit(p, d, 200.0);
    ASSERT_TRUE(hit.has_value());
    EXPECT_NEAR(hit->distance_mm, -b + std::sqrt(b * b - c), 0.05);
    EXPECT_FALSE(index.first_hit(p, d, hit->distance_mm * 0.999).has_value());
  }
  EXPECT_FALSE(index.first_hit({60, 0, 0}, {1, 0, 0}, 1000.0).has_value());
  EXPECT_NEAR(index.first_hit({60, 0, 0}, {-1, 0, 0}, 1000.0)->distance_mm, 10.0, 0.05);
}

TEST(MeshIndex, NoRayFromInsideSlipsThroughEdgesOrCorners) {
  const Mesh mesh = fixtures::sphere_mesh({0, 0, 0}, 50.0, 2);
  const MeshIndex index(mesh);
  for (const glm::uvec3& t : mesh.triangles)
    for (int corner = 0; corner < 3; ++corner) {
      const glm::dvec3 a(mesh.vertices_lps_mm[t[corner]]), b(mesh.vertices_lps_mm[t[(corner + 1) % 3]]);
      EXPECT_TRUE(index.first_hit({0, 0, 0}, glm::normalize(a), 100.0).has_value());
      EXPECT_TRUE(index.first_hit({0, 0, 0}, glm::normalize(a + b), 100.0).has_value());
    }
}

TEST(MeshIndex, TheAnswerIsEquivariantUnderARigidMotion) {
  Mesh mesh = fixtures::sphere_mesh({0, 0, 0}, 40.0, 3, 4.0);
  const MeshIndex before(mesh);
  const auto moved = [](const glm::dvec3& p) { return glm::dvec3(-p.y, p.x, p.z) + glm::dvec3(512, -256, 64); };
  for (glm::vec3& v : mesh.vertices_lps_mm) v = glm::vec3(moved(glm::dvec3(v)));
  const MeshIndex after(mesh);
  base::Rng rng(5);
  for (int i = 0; i < 500; ++i) {
    const glm::dvec3 p = point_within(rng, 60.0);
    EXPECT_NEAR(before.closest(p).distance_mm, after.closest(moved(p)).distance_mm, 1e-4);  // float vertices moved
  }
}

TEST(MeshIndex, TrianglesWithoutAreaOrOnlyCapsGiveFiniteAnswers) {
  Mesh mesh = fixtures::box_mesh({-1, -1, -1}, {1, 1, 1});
  mesh.triangles.push_back({0, 0, 0});
  mesh.triangles.push_back({0, 0, 1});
  mesh.cut.resize(mesh.triangles.size(), 0);
  const MeshIndex index(mesh);
  for (std::uint32_t hint = 0; hint < mesh.triangles.size(); ++hint)
    EXPECT_NEAR(index.closest({3, 0, 0}, hint).distance_mm, 2.0, 1e-12) << hint;
  std::fill(mesh.cut.begin(), mesh.cut.end(), std::uint8_t{1});
  EXPECT_NEAR(MeshIndex(mesh).closest_skin({3, 0, 0}).distance_mm, 2.0, 1e-12);
}

// A mesh far from the origin, where float is coarse, and rays along its axes and in the planes of its boxes.
TEST(MeshIndex, RaysHitWhatEveryTriangleTriedHits) {
  Mesh mesh = fixtures::sphere_mesh({700, -900, 1200}, 40.0, 4, 4.0);
  const MeshIndex index(mesh);
  base::Rng rng(11);
  int hits = 0;
  for (int i = 0; i < 600; ++i) {
    glm::dvec3 p = glm::dvec3(700, -900, 1200) + point_within(rng, 60.0);
    glm::dvec3 d = point_within(rng, 1.0);
    if (i % 3 == 0) {
      d = glm::dvec3(0.0);
      d[i % 9 / 3] = i % 2 == 0 ? 1.0 : -1.0;
      p[(i + 1) % 3] = mesh.vertices_lps_mm[static_cast<std::size_t>(i)][(i + 1) % 3];
    }
    d = glm::normalize(d);
    double best = 80.0;
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
      // The plane, then the sides of the three edges: a way that shares nothing with the index.
      const glm::uvec3& v = mesh.triangles[t];
      const glm::dvec3 a(mesh.vertices_lps_mm[v.x]), b(mesh.vertices_lps_mm[v.y]), c(mesh.vertices_lps_mm[v.z]);
      const glm::dvec3 n = glm::cross(b - a, c - a);
      const double along = glm::dot(d, n);
      if (along == 0.0) continue;
      const double t_mm = glm::dot(a - p, n) / along;
      const glm::dvec3 q = p + d * t_mm;
      if (t_mm > 0.0 && t_mm < best && glm::dot(glm::cross(b - a, q - a), n) >= 0.0 &&
          glm::dot(glm::cross(c - b, q - b), n) >= 0.0 && glm::dot(glm::cross(a - c, q - c), n) >= 0.0)
        best = t_mm;
    }
    const auto hit = index.first_hit(p, d, 80.0);
    EXPECT_NEAR(hit ? hit->distance_mm : 80.0, best, 1e-6) << i;
    hits += hit ? 1 : 0;
  }
  EXPECT_GT(hits, 150);
}

TEST(MeshIndex, AMovingBallStopsWhereItsDistanceIsItsRadius) {
  const Mesh mesh = fixtures::sphere_mesh({300, 0, -200}, 40.0, 4, 4.0);
  const MeshIndex index(mesh);
  base::Rng rng(12);
  int touches = 0;
  for (const double radius : {0.01, 1.0, 7.0})
    for (int i = 0; i < 300; ++i) {
      const glm::dvec3 p = glm::dvec3(300, 0, -200) + point_within(rng, 70.0);
      const glm::dvec3 d = glm::normalize(point_within(rng, 1.0));
      const double slack = 0.1 * radius;
      if (std::abs(index.closest(p).distance_mm) < radius) continue;
      const auto touch = index.first_touch(p, d, 60.0, radius, slack, static_cast<std::uint32_t>(i));
      const double free_mm = touch ? touch->travel_mm : 60.0;
      double least = 1e9;
      for (int k = 0; k <= 200; ++k)
        least = std::fmin(least, std::abs(index.closest(p + d * (free_mm * k / 200.0)).distance_mm));
      EXPECT_GE(least, radius - slack - 1e-9) << i;
      const auto hinted = index.first_touch(p, d, 60.0, radius, slack, touch ? touch->triangle : 7);
      EXPECT_EQ(touch.has_value(), hinted.has_value());
      if (!touch || !hinted) continue;
      ++touches;
      const Closest at = index.closest(p + d * touch->travel_mm);
      EXPECT_NEAR(touch->distance_mm, radius, slack * 0.3);
      EXPECT_LE(std::abs(at.distance_mm), touch->distance_mm + 1e-9);
      EXPECT_LT(glm::dot(touch->normal, d), 0.0);
      EXPECT_NEAR(hinted->travel_mm, touch->travel_mm, slack);
    }
  EXPECT_GT(touches, 100);
}

TEST(MeshIndex, ABallThatOnlySlidesAlongMeetsNothing) {
  const MeshIndex index(fixtures::box_mesh({-10, -10, -10}, {10, 10, 10}));
  EXPECT_FALSE(index.first_touch({-5, 0, 11}, {1, 0, 0}, 10.0, 1.0, 0.001).has_value());
  EXPECT_FALSE(index.first_touch({-5, 0, 11}, {0, 0, 1}, 10.0, 1.0, 0.001).has_value());
  const auto down = index.first_touch({-5, 0, 14}, {0, 0, -1}, 10.0, 1.0, 0.001);
  ASSERT_TRUE(down.has_value());
  EXPECT_NEAR(down->travel_mm, 3.0, 1e-9);
  EXPECT_NEAR(down->normal.z, 1.0, 1e-12);
}

TEST(MeshIndex, ATriangleWithoutAreaIsItsEdges) {
  Mesh mesh;
  mesh.vertices_lps_mm = {{0, 0, 0}, {10, 0, 0}, {4, 0, 0}};
  for (const glm::uvec3& t : {glm::uvec3(0, 1, 2), glm::uvec3(0, 0, 1), glm::uvec3(1, 0, 0), glm::uvec3(2, 1, 0)}) {
    mesh.triangles = {t};
    EXPECT_NEAR(std::abs(MeshIndex(mesh).closest({9, 3, 4}).distance_mm), 5.0, 1e-12) << t.x << t.y << t.z;
    EXPECT_NEAR(std::abs(MeshIndex(mesh).closest({13, 0, 4}).distance_mm), 5.0, 1e-12) << t.x << t.y << t.z;
  }
}

// A centre of 1e155 mm, out of a bundle, made every box seem near, also those that are empty: the search left its
// stack (SIGSEGV), and a NaN ended the program by a CHECK.
TEST(MeshIndex, AnyDoubleIsBorne) {
  Mesh mesh = fixtures::sphere_mesh({3, -2, 5}, 40.0, 3, 4.0);
  for (std::size_t t = 0; t < mesh.cut.size(); t += 3) mesh.cut[t] = 1;
  const MeshIndex index(mesh);
  constexpr double kInf = std::numeric_limits<double>::infinity(), kNan = std::numeric_limits<double>::quiet_NaN();
  const double values[] = {0.0,    1e15,  -1e15, 1.1e15, -1e19, 1e20,  1e38,   -1e39,  1e154,
                           -1e155, 1e300, kInf,  -kInf,  kNan,  1e308, -1e308, 5e-324, 1.7976931348623157e308};
  for (const double x : values)
    for (const double y : values)
      for (const double z : values) {
        const glm::dvec3 p(x, y, z);
        const bool is_point = !std::isnan(x) && !std::isnan(y) && !std::isnan(z);
        for (const Closest& one : {index.closest(p, 7), index.closest_skin(p)}) {
          ASSERT_LT(one.triangle, mesh.triangles.size());
          ASSERT_EQ(std::isnan(one.distance_mm), !is_point) << x << " " << y << " " << z;
          const double far = std::max({std::abs(x), std::abs(y), std::abs(z)});
          if (is_point && far >= 1.0 && far <= 1e300) {
            ASSERT_NEAR(one.distance_mm / std::hypot(x, y, z), 1.0, 1e-9);
          }
          if (is_point && far > 1e300) {
            ASSERT_GE(one.distance_mm, 1e300);
          }
        }
        const auto hit = index.first_hit(p, {0, 0, 1}, kInf);
        ASSERT_TRUE(!hit || hit->triangle < mesh.triangles.size());
        if (!is_point) {
          ASSERT_FALSE(hit.has_value());
        }
        ASSERT_FALSE(index.first_hit({0, 0, 0}, {0, 0, 1}, kNan).has_value());
        const auto touch = index.first_touch(p, {0, 1, 0}, 1e9, 1.0, 0.1);
        ASSERT_TRUE(!touch || touch->triangle < mesh.triangles.size());
      }
}

TEST(MeshBytes, RoundTripAndDamage) {
  Mesh mesh = fixtures::sphere_mesh({1, 2, 3}, 30.0, 2, 1.0);
  mesh.cut[5] = 1;
  const auto bytes = bytes_from_mesh(mesh);
  const auto back = mesh_from_bytes(bytes);
  ASSERT_TRUE(back.has_value());
  EXPECT_EQ(back->vertices_lps_mm, mesh.vertices_lps_mm);
  EXPECT_EQ(back->triangles, mesh.triangles);
  EXPECT_EQ(back->cut, mesh.cut);
  for (std::size_t length : {std::size_t{0}, std::size_t{3}, bytes.size() / 2, bytes.size() - 1})
    EXPECT_FALSE(mesh_from_bytes(std::span(bytes).first(length)).has_value()) << length;
  for (std::size_t i = 0; i < bytes.size(); i += 7) {
    auto damaged = bytes;
    damaged[i] ^= std::byte{0x40};
    const auto read = mesh_from_bytes(damaged);
    if (read) {
      EXPECT_EQ(read->triangles, mesh.triangles) << i;  // a bit that means nothing
    }
  }
  for (const float far : {1e8F, -3e38F, std::numeric_limits<float>::infinity(), std::nanf("")}) {
    Mesh other = mesh;
    other.vertices_lps_mm[3].y = far;
    EXPECT_FALSE(mesh_from_bytes(bytes_from_mesh(other)).has_value()) << far;
  }
  mesh.triangles[0].x = 9999;
  EXPECT_FALSE(mesh_from_bytes(bytes_from_mesh(mesh)).has_value());
}

}  // namespace
}  // namespace seldinger::cases
