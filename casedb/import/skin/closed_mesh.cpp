#include "casedb/import/skin/closed_mesh.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <numeric>

namespace seldinger::casedb {

bool is_closed(const cases::Mesh& mesh) {
  std::vector<std::uint64_t> forward, backward;
  forward.reserve(mesh.triangles.size() * 3);
  backward.reserve(mesh.triangles.size() * 3);
  for (const glm::uvec3& triangle : mesh.triangles)
    for (int side = 0; side < 3; ++side) {
      const std::uint64_t from = triangle[side], to = triangle[(side + 1) % 3];
      if (from == to) return false;
      forward.push_back(from << 32 | to);
      backward.push_back(to << 32 | from);
    }
  std::sort(forward.begin(), forward.end());
  std::sort(backward.begin(), backward.end());
  return !forward.empty() && forward == backward &&
         std::adjacent_find(forward.begin(), forward.end()) == forward.end();
}

double signed_volume_mm3(const cases::Mesh& mesh) {
  if (mesh.vertices_lps_mm.empty()) return 0.0;
  const glm::dvec3 middle(mesh.vertices_lps_mm.front());  // near the mesh, so that nothing cancels
  double six_volumes = 0.0;
  for (const glm::uvec3& triangle : mesh.triangles) {
    const glm::dvec3 a = glm::dvec3(mesh.vertices_lps_mm[triangle.x]) - middle,
                     b = glm::dvec3(mesh.vertices_lps_mm[triangle.y]) - middle,
                     c = glm::dvec3(mesh.vertices_lps_mm[triangle.z]) - middle;
    six_volumes += glm::dot(a, glm::cross(b, c));
  }
  return six_volumes / 6.0;
}

cases::Mesh largest_piece(const cases::Mesh& mesh) {
  std::vector<std::uint32_t> parent(mesh.vertices_lps_mm.size());
  std::iota(parent.begin(), parent.end(), 0U);
  const auto root = [&](std::uint32_t vertex) {
    while (parent[vertex] != vertex) vertex = parent[vertex] = parent[parent[vertex]];
    return vertex;
  };
  for (const glm::uvec3& triangle : mesh.triangles) {
    parent[root(triangle.y)] = root(triangle.x);
    parent[root(triangle.z)] = root(triangle.x);
  }
  std::vector<std::uint32_t> count(parent.size(), 0);
  for (const glm::uvec3& triangle : mesh.triangles) ++count[root(triangle.x)];
  cases::Mesh piece;
  if (mesh.triangles.empty()) return piece;
  const auto largest = static_cast<std::uint32_t>(std::max_element(count.begin(), count.end()) - count.begin());
  constexpr std::uint32_t kUnused = UINT32_MAX;
  std::vector<std::uint32_t> moved(parent.size(), kUnused);
  for (const glm::uvec3& triangle : mesh.triangles) {
    if (root(triangle.x) != largest) continue;
    glm::uvec3 kept;
    for (int corner = 0; corner < 3; ++corner) {
      std::uint32_t& to = moved[triangle[corner]];
      if (to == kUnused) {
        to = static_cast<std::uint32_t>(piece.vertices_lps_mm.size());
        piece.vertices_lps_mm.push_back(mesh.vertices_lps_mm[triangle[corner]]);
      }
      kept[corner] = to;
    }
    piece.triangles.push_back(kept);
  }
  return piece;
}

}  // namespace seldinger::casedb
