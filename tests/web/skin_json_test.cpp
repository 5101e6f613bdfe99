// The net of a skin, against a ball whose surface is known.
#include "web/json/skin_json.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <sstream>
#include <string>
#include <vector>

namespace seldinger::web {
namespace {

// A ball of so many rings and meridians around a centre, and a cap that closes nothing.
cases::Mesh ball(glm::vec3 center, float radius_mm, unsigned rings) {
  cases::Mesh mesh;
  const unsigned around = 2 * rings;
  for (unsigned i = 0; i <= rings; ++i)
    for (unsigned k = 0; k < around; ++k) {
      const float polar = 3.14159265F * static_cast<float>(i) / static_cast<float>(rings);
      const float turn = 6.2831853F * static_cast<float>(k) / static_cast<float>(around);
      mesh.vertices_lps_mm.push_back(center + radius_mm * glm::vec3(std::sin(polar) * std::cos(turn),
                                                                    std::sin(polar) * std::sin(turn),
                                                                    std::cos(polar)));
    }
  for (unsigned i = 0; i < rings; ++i)
    for (unsigned k = 0; k < around; ++k) {
      const unsigned a = i * around + k, b = i * around + (k + 1) % around;
      mesh.triangles.emplace_back(a, a + around, b);
      mesh.triangles.emplace_back(b, a + around, b + around);
    }
  mesh.cut.assign(mesh.triangles.size(), 0);
  mesh.vertices_lps_mm.emplace_back(9999.0F, 9999.0F, 9999.0F);
  const auto far = static_cast<unsigned>(mesh.vertices_lps_mm.size() - 1);
  mesh.triangles.emplace_back(0U, 40U, far);
  mesh.cut.push_back(1);
  return mesh;
}

std::vector<int> row_of(std::string json, const std::string& name) {
  json = json.substr(json.find("\"" + name + "\":[") + name.size() + 4);
  std::istringstream numbers(json.substr(0, json.find(']')));
  std::vector<int> row;
  for (int one = 0; numbers >> one; numbers.ignore(1)) row.push_back(one);
  return row;
}

TEST(SkinJson, IsACoarseNetThatLiesOnTheSkin) {
  const glm::dvec3 center(12.0, -34.0, 500.0);
  for (const unsigned rings : {10U, 300U}) {  // 220 and 180,600 vertices
    const std::string text = skin_json(ball(center, 180.0F, rings));
    const std::vector<int> flat = row_of(text, "vertices_mm"), corners = row_of(text, "triangles");
    const std::size_t vertices = flat.size() / 3;
    ASSERT_EQ(flat.size() % 3, 0U);
    ASSERT_EQ(corners.size() % 3, 0U);
    EXPECT_LE(vertices, kMostSkinVertices);
    EXPECT_GE(vertices, 150U) << "a net, not a lump";
    EXPECT_GE(corners.size() / 3, vertices) << "a closed surface has about two triangles a vertex";
    EXPECT_LE(text.size(), 100'000U);
    for (std::size_t i = 0; i < vertices; ++i) {
      const glm::dvec3 at(flat[3 * i], flat[3 * i + 1], flat[3 * i + 2]);
      // A mean of a cell of 36 mm at most lies inside by its chord's height, 36² · 3 / (8 · 180).
      EXPECT_NEAR(glm::length(at - center), 180.0, 4.0) << i;
    }
    for (const int i : corners) EXPECT_LT(i, static_cast<int>(vertices));
  }
}

TEST(SkinJson, OfNoSkinThereIsAnEmptyNet) {
  EXPECT_EQ(skin_json({}), "{\"vertices_mm\":[],\"triangles\":[]}\n");
}

}  // namespace
}  // namespace seldinger::web
