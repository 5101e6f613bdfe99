// The skin is one closed surface that faces outwards, lies where the body ends, and knows its caps.
#include "casedb/import/skin/surface.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <numbers>

#include "sim/case/form/mesh_index.h"

namespace seldinger::casedb {
namespace {

// Written apart from the library's own check: every directed edge once, and its opposite once.
void expect_closed(const cases::Mesh& mesh) {
  std::map<std::pair<unsigned, unsigned>, int> edges;
  for (const glm::uvec3& t : mesh.triangles)
    for (int side = 0; side < 3; ++side) ++edges[{t[side], t[(side + 1) % 3]}];
  std::size_t open = 0, repeated = 0;
  for (const auto& [edge, count] : edges) {
    if (count != 1) ++repeated;
    if (!edges.contains({edge.second, edge.first})) ++open;
  }
  EXPECT_EQ(open, 0U);
  EXPECT_EQ(repeated, 0U);
  EXPECT_EQ(mesh.cut.size(), mesh.triangles.size());
  EXPECT_FALSE(mesh.triangles.empty());
}

double enclosed_mm3(const cases::Mesh& mesh) {
  double sum = 0.0;
  for (const glm::uvec3& t : mesh.triangles) {
    const glm::dvec3 a(mesh.vertices_lps_mm[t.x]), b(mesh.vertices_lps_mm[t.y]), c(mesh.vertices_lps_mm[t.z]);
    sum += glm::dot(a, glm::cross(b, c)) / 6.0;
  }
  return sum;
}

double smallest_area_mm2(const cases::Mesh& mesh) {
  double smallest = 1e9;
  for (const glm::uvec3& t : mesh.triangles) {
    const glm::dvec3 a(mesh.vertices_lps_mm[t.x]), b(mesh.vertices_lps_mm[t.y]), c(mesh.vertices_lps_mm[t.z]);
    const double area = 0.5 * glm::length(glm::cross(b - a, c - a));
    if (!(area >= smallest)) smallest = area;
  }
  return smallest;
}

// Grey values fall from tissue to air across the edge as a scanner shows it: the −300 HU surface is where the
// distance is 0.
template <typename Distance>
volume::Volume scanned(glm::ivec3 size, glm::dvec3 spacing_mm, const glm::dmat3& direction, glm::dvec3 origin_mm,
                       Distance&& distance_mm) {
  volume::Volume v = volume::make_volume(size, spacing_mm, direction, origin_mm);
  for (int k = 0; k < size.z; ++k)
    for (int j = 0; j < size.y; ++j)
      for (int i = 0; i < size.x; ++i) {
        const double d = distance_mm(glm::dvec3(v.lps_from_voxel * glm::dvec4(i, j, k, 1.0)));
        v.hu[v.index(i, j, k)] =
            static_cast<std::int16_t>(std::lround(std::clamp(-300.0 - 200.0 * d, -1000.0, 40.0)));
      }
  return v;
}

TEST(SkinSurface, ASphereIsRoundWholeAndInPlace) {
  const double radius_mm = 40.0;
  const glm::dvec3 middle(7.3, -11.1, 101.7);
  const auto distance = [&](const glm::dvec3& p) { return glm::length(p - middle) - radius_mm; };
  const glm::dmat3 left_handed({1, 0, 0}, {0, 1, 0}, {0, 0, -1});
  const volume::Volume volumes[] = {
      scanned({101, 101, 101}, glm::dvec3(1.0), glm::dmat3(1.0), middle - 50.0, distance),
      scanned({100, 99, 41}, {0.98, 1.01, 2.5}, glm::dmat3(1.0), middle - glm::dvec3(49.0, 50.0, 50.0), distance),
      scanned({101, 101, 51}, {1.0, 1.0, 2.0}, left_handed, middle + glm::dvec3(-50.0, -50.0, 50.0), distance)};
  for (const volume::Volume& v : volumes) {
    const auto mesh = skin_surface(v);
    ASSERT_TRUE(mesh);
    expect_closed(*mesh);
    const double whole = 4.0 / 3.0 * std::numbers::pi * std::pow(radius_mm, 3);
    EXPECT_NEAR(enclosed_mm3(*mesh) / whole, 1.0, 0.02);
    double worst = 0.0;
    for (const glm::vec3& p : mesh->vertices_lps_mm) {
      const double off = std::abs(distance(glm::dvec3(p)));
      if (!(off <= worst)) worst = off;
    }
    EXPECT_LT(worst, 0.5);
    EXPECT_EQ(std::count(mesh->cut.begin(), mesh->cut.end(), 1), 0);
    EXPECT_GT(smallest_area_mm2(*mesh), 0.0);
    const cases::MeshIndex index(*mesh);
    EXPECT_NEAR(index.closest(middle).distance_mm, -radius_mm, 0.5);  // inside is negative: normals face outwards
  }
}

TEST(SkinSurface, ABoxKeepsItsVolumeAndSides) {
  const glm::dvec3 low(-30.0, -20.0, -25.0), high(31.0, 24.0, 27.0);
  const auto distance = [&](const glm::dvec3& p) {
    const glm::dvec3 d = glm::max(low - p, p - high);
    return std::max({d.x, d.y, d.z});
  };
  const auto mesh = skin_surface(
      scanned({80, 70, 80}, glm::dvec3(1.0), glm::dmat3(1.0), glm::dvec3(-40.0, -33.0, -40.0), distance));
  ASSERT_TRUE(mesh);
  expect_closed(*mesh);
  const glm::dvec3 size = high - low;
  EXPECT_NEAR(enclosed_mm3(*mesh) / (size.x * size.y * size.z), 1.0, 0.02);
  double outermost = -1e9;
  for (const glm::vec3& p : mesh->vertices_lps_mm) outermost = std::max(outermost, distance(glm::dvec3(p)));
  EXPECT_LT(outermost, 0.5);
  EXPECT_EQ(std::count(mesh->cut.begin(), mesh->cut.end(), 1), 0);
}

// A cylinder along z through the whole volume: its ends are caps on the volume's faces.
struct Cylinder {
  double radius_mm = 35.0;
  double distance(const glm::dvec3& p) const { return std::hypot(p.x, p.y) - radius_mm; }
};

TEST(SkinSurface, ABodyThatLeavesTheVolumeIsCappedOnItsFaces) {
  const Cylinder body;
  const auto distance = [&](const glm::dvec3& p) { return body.distance(p); };
  // 45 slices do not divide by the block of 2: the last block is half.
  for (const int slices : {44, 45}) {
    const volume::Volume v =
        scanned({90, 90, slices}, {1.0, 1.0, 0.9}, glm::dmat3(1.0), glm::dvec3(-44.3, -44.6, 100.0), distance);
    const double bottom_mm = 100.0 - 0.45, top_mm = 100.0 + 0.9 * (slices - 0.5);
    const auto mesh = skin_surface(v);
    ASSERT_TRUE(mesh);
    expect_closed(*mesh);
    const double area = std::numbers::pi * body.radius_mm * body.radius_mm;
    EXPECT_NEAR(enclosed_mm3(*mesh) / (area * (top_mm - bottom_mm)), 1.0, 0.02) << slices;
    double cap_area = 0.0;
    for (std::size_t i = 0; i < mesh->triangles.size(); ++i) {
      const glm::uvec3 t = mesh->triangles[i];
      const glm::dvec3 a(mesh->vertices_lps_mm[t.x]), b(mesh->vertices_lps_mm[t.y]), c(mesh->vertices_lps_mm[t.z]);
      const double low = std::min({a.z, b.z, c.z}), high = std::max({a.z, b.z, c.z});
      const bool on_face = high < bottom_mm + 1e-3 || low > top_mm - 1e-3;
      EXPECT_EQ(mesh->cut[i] != 0, on_face);
      if (mesh->cut[i] != 0) cap_area += 0.5 * glm::length(glm::cross(b - a, c - a));
    }
    EXPECT_NEAR(cap_area / (2.0 * area), 1.0, 0.02) << slices;
    double worst = 0.0;
    for (const glm::vec3& p : mesh->vertices_lps_mm)
      if (p.z > bottom_mm + 3.0 && p.z < top_mm - 3.0)
        worst = std::max(worst, std::abs(body.distance(glm::dvec3(p))));
    EXPECT_LT(worst, 0.5);
  }
}

TEST(SkinSurface, ABodyCutAtEverySideIsABoxOfCaps) {
  volume::Volume v = volume::make_volume({30, 20, 10}, {1.0, 2.0, 3.0}, glm::dmat3(1.0), glm::dvec3(0.0));
  std::fill(v.hu.begin(), v.hu.end(), std::int16_t{40});
  const auto mesh = skin_surface(v);
  ASSERT_TRUE(mesh);
  expect_closed(*mesh);
  EXPECT_NEAR(enclosed_mm3(*mesh) / (30.0 * 40.0 * 30.0), 1.0, 0.01);
}

TEST(SkinSurface, OneSliceIsAPlateBetweenTwoCaps) {
  const Cylinder body;
  const auto mesh =
      skin_surface(scanned({90, 90, 1}, {1.0, 1.0, 5.0}, glm::dmat3(1.0), glm::dvec3(-44.5, -44.5, 0.0),
                           [&](const glm::dvec3& p) { return body.distance(p); }));
  ASSERT_TRUE(mesh);
  expect_closed(*mesh);
  EXPECT_NEAR(enclosed_mm3(*mesh) / (std::numbers::pi * 35.0 * 35.0 * 5.0), 1.0, 0.02);
}

TEST(SkinSurface, LungsAreFilledAndTheCouchIsDropped) {
  const Cylinder body;
  volume::Volume v = scanned({110, 110, 30}, {1.0, 1.0, 2.0}, glm::dmat3(1.0), glm::dvec3(-54.5, -54.5, 0.0),
                             [&](const glm::dvec3& p) { return body.distance(p); });
  for (int k = 0; k < 30; ++k) {
    for (int j = 45; j < 65; ++j)
      for (int i = 40; i < 60; ++i) v.hu[v.index(i, j, k)] = -850;  // a lung, open at both ends
    for (int j = 95; j < 99; ++j)
      for (int i = 2; i < 108; ++i) v.hu[v.index(i, j, k)] = 180;  // a couch
  }
  const auto mesh = skin_surface(v);
  ASSERT_TRUE(mesh);
  expect_closed(*mesh);
  EXPECT_NEAR(enclosed_mm3(*mesh) / (std::numbers::pi * 35.0 * 35.0 * 60.0), 1.0, 0.02);
  for (const glm::vec3& p : mesh->vertices_lps_mm) EXPECT_LT(body.distance(glm::dvec3(p)), 0.5);
  // A straight way through the lung crosses the skin twice: in and out.
  const cases::MeshIndex index(*mesh);
  glm::dvec3 p(-4.5, 53.0, 30.0);
  int crossings = 0;
  while (const auto hit = index.first_hit(p, {0, -1, 0}, 200.0)) {
    ++crossings;
    EXPECT_FALSE(hit->cut);
    p.y -= hit->distance_mm + 1e-3;
  }
  EXPECT_EQ(crossings, 2);
}

TEST(SkinSurface, AirHasNoSkin) {
  const auto mesh =
      skin_surface(volume::make_volume({10, 10, 10}, glm::dvec3(1.0), glm::dmat3(1.0), glm::dvec3(0.0)));
  ASSERT_FALSE(mesh);
  EXPECT_EQ(mesh.error().code, "no_body");
}

TEST(SkinSurface, DecimationAndSmoothingCanBeLeftAway) {
  const Cylinder body;
  const volume::Volume v = scanned({90, 90, 20}, {1.0, 1.0, 2.0}, glm::dmat3(1.0), glm::dvec3(-44.5, -44.5, 0.0),
                                   [&](const glm::dvec3& p) { return body.distance(p); });
  const auto full = skin_surface(v, {.decimate_share = 0.0, .smoothing_iterations = 0}), usual = skin_surface(v);
  ASSERT_TRUE(full && usual);
  expect_closed(*full);
  const double share = static_cast<double>(usual->triangles.size()) / static_cast<double>(full->triangles.size());
  EXPECT_NEAR(share, 0.3, 0.02);
}

}  // namespace
}  // namespace seldinger::casedb
