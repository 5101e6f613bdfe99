// Closest point, signed distance, rays and moving balls on a mesh, in double, with the same bits on every machine.
// A bounding-volume tree built once; queries allocate nothing. Only the sign needs the mesh closed.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <vector>

#include "sim/case/form/mesh.h"

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

// Where a moving ball first touches.
struct BallTouch {
  double travel_mm = 0.0;
  glm::dvec3 normal{0.0};    // unit: from the touched place to the ball's middle
  double distance_mm = 0.0;  // between these
  std::uint32_t triangle = 0;
};

class MeshIndex {
 public:
  MeshIndex() = default;
  explicit MeshIndex(const Mesh& mesh);

  bool empty() const noexcept { return triangles_.empty(); }

  // Sign by angle-weighted pseudonormals (Bærentzen and Aanæs, IEEE TVCG 11, 2005), right at edges and vertices
  // too. `hint` is any triangle; a near one (the last answer) makes the query faster and never changes it. Bears
  // any doubles: the distance is NaN where one of them is; rays and balls from farther than 10¹⁵ mm meet nothing.
  Closest closest(const glm::dvec3& p_lps_mm, std::uint32_t hint = 0) const noexcept;

  // As closest, among the triangles that are skin (not cut caps): the sign is that of the whole closed mesh.
  Closest closest_skin(const glm::dvec3& p_lps_mm, std::uint32_t hint = 0) const noexcept;

  // First crossing of p + t·direction, t in (0, max_mm], from either side. direction has unit length.
  std::optional<RayHit> first_hit(const glm::dvec3& p_lps_mm, const glm::dvec3& direction,
                                  double max_mm) const noexcept;

  // A ball whose middle moves from p along the unit vector `direction` by length_mm: where it comes within
  // radius_mm of the triangle that it would first be nearer to than radius_mm − slack_mm. So until there it keeps
  // that distance from all, from either side, whatever their orientation or shape; what it only slides along is not
  // met. Of a triangle that is nearer already it is kept from coming nearer still. 0 < slack_mm < radius_mm
  // (CHECKed). `hint` is any triangle; a near one makes the query faster.
  std::optional<BallTouch> first_touch(const glm::dvec3& p_lps_mm, const glm::dvec3& direction, double length_mm,
                                       double radius_mm, double slack_mm, std::uint32_t hint = 0) const noexcept;

  // Outward unit normal of a triangle.
  glm::dvec3 normal(std::uint32_t triangle) const noexcept;
  bool cut(std::uint32_t triangle) const noexcept;

 private:
  // Four children side by side: boxes are tried in float, four at once, widened by what float can be wrong (they
  // only sort out; what counts is worked out in double from the triangles).
  struct Node {
    float low[3][4], high[3][4];  // mm; vertices are float, so these bounds are exact
    std::uint32_t first[4];       // leaf: first of count triangles; inner: the child's node
    std::uint32_t count[4];       // 0 = inner
  };
  struct Triangle {
    glm::vec3 a, b, c;
    std::uint32_t id = 0;
    bool cut = false;
    bool thin = false;  // without area to speak of: its edges are all there is
  };
  struct Normals {
    glm::dvec3 face;
    glm::dvec3 edge[3];    // of ab, bc, ca: sum of the two faces' normals
    glm::dvec3 vertex[3];  // angle weighted
  };
  struct Nearest;
  struct Ray;
  class Builder;

  void make_normals(const Mesh& mesh);
  double box_error_mm(const glm::dvec3& p_lps_mm) const noexcept;
  // Visits the triangles near a ray before best_mm, which `visit` may shorten; boxes entered earlier come first.
  template <class Visit>
  void walk(const Ray& ray, double& best_mm, Visit visit) const noexcept;
  void visit(const glm::dvec3& p, bool skin_only, Nearest& nearest) const noexcept;
  Closest answer(const glm::dvec3& p, std::uint32_t hint, bool skin_only) const noexcept;
  Closest far_answer(const glm::dvec3& p, std::uint32_t hint, bool skin_only) const noexcept;

  std::vector<Node> nodes_;
  double reach_mm_ = 0.0;                // greatest coordinate, ±
  std::vector<Normals> normals_;         // by triangle id
  std::vector<Triangle> triangles_;      // in tree order
  std::vector<std::uint32_t> position_;  // triangle id → place in triangles_
};

}  // namespace seldinger::cases
