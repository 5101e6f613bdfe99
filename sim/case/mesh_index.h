// Closest point, signed distance and ray queries on a closed mesh, in double, with the same bits on every machine.
// A bounding-volume tree built once; queries allocate nothing.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <vector>

#include "sim/case/mesh.h"

namespace seldinger::cases {

struct Closest {
  double distance_mm = 0.0;  // > 0 outside the closed mesh, < 0 inside
  glm::dvec3 point_lps_mm{0.0};
  std::uint32_t triangle = 0;
};

struct RayHit {
  double distance_mm = 0.0;
  std::uint32_t triangle = 0;
  bool cut = false;
};

class MeshIndex {
 public:
  MeshIndex() = default;
  explicit MeshIndex(const Mesh& mesh);

  bool empty() const noexcept { return triangles_.empty(); }

  // Sign by angle-weighted pseudonormals (Bærentzen and Aanæs, IEEE TVCG 11, 2005), right at edges and vertices
  // too. `hint` is any triangle; a near one (the last answer) makes the query faster and never changes it.
  Closest closest(const glm::dvec3& p_lps_mm, std::uint32_t hint = 0) const noexcept;

  // As closest, among the triangles that are skin (not cut caps): the sign is that of the whole closed mesh.
  Closest closest_skin(const glm::dvec3& p_lps_mm, std::uint32_t hint = 0) const noexcept;

  // First crossing of p + t·direction, t in (0, max_mm], from either side. direction has unit length.
  std::optional<RayHit> first_hit(const glm::dvec3& p_lps_mm, const glm::dvec3& direction,
                                  double max_mm) const noexcept;

  // Outward unit normal of a triangle.
  glm::dvec3 normal(std::uint32_t triangle) const noexcept;
  bool cut(std::uint32_t triangle) const noexcept;

 private:
  // What a query touches is kept small: a pair of sibling nodes is one cache line, normals stand apart.
  struct Node {
    glm::vec3 min_mm, max_mm;  // vertices are float, so these bounds are exact
    std::uint32_t first = 0;   // leaf: first of count triangles; inner: index of the left child, right = +1
    std::uint32_t count = 0;   // 0 = inner
  };
  struct Triangle {
    glm::dvec3 a, b, c;
    std::uint32_t id = 0;
    bool cut = false;
  };
  struct Normals {
    glm::dvec3 face;
    glm::dvec3 edge[3];    // of ab, bc, ca: sum of the two faces' normals
    glm::dvec3 vertex[3];  // angle weighted
  };
  struct Nearest;

  void build(std::uint32_t node, std::uint32_t begin, std::uint32_t end);
  void visit(const glm::dvec3& p, bool skin_only, Nearest& nearest) const noexcept;
  Closest answer(const glm::dvec3& p, std::uint32_t hint, bool skin_only) const noexcept;

  std::vector<Node> nodes_;
  std::vector<Normals> normals_;         // by triangle id
  std::vector<Triangle> triangles_;      // in tree order
  std::vector<std::uint32_t> position_;  // triangle id → place in triangles_
};

}  // namespace seldinger::cases
