#include "sim/case/mesh_index.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <tuple>

#include "sim/base/check.h"
#include "sim/base/exact_math.h"

namespace seldinger::cases {
namespace {

constexpr std::uint32_t kLeafTriangles = 4;
constexpr int kMaxDepth = 64;

struct OnTriangle {
  glm::dvec3 point;
  int feature;  // 0..2 vertices a b c, 3..5 edges ab bc ca, 6 face
};

// Shares along an edge; an edge without length has none.
double share_of(double part, double whole) {
  return whole > 0.0 ? part / whole : 0.0;
}

// Closest point of a triangle by Voronoi regions (Ericson, Real-Time Collision Detection, 2005, §5.1.5).
OnTriangle closest_on_triangle(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
  const glm::dvec3 ab = b - a, ac = c - a, ap = p - a;
  const double d1 = glm::dot(ab, ap), d2 = glm::dot(ac, ap);
  if (d1 <= 0.0 && d2 <= 0.0) return {a, 0};
  const glm::dvec3 bp = p - b;
  const double d3 = glm::dot(ab, bp), d4 = glm::dot(ac, bp);
  if (d3 >= 0.0 && d4 <= d3) return {b, 1};
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0) return {a + ab * share_of(d1, d1 - d3), 3};
  const glm::dvec3 cp = p - c;
  const double d5 = glm::dot(ab, cp), d6 = glm::dot(ac, cp);
  if (d6 >= 0.0 && d5 <= d6) return {c, 2};
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0) return {a + ac * share_of(d2, d2 - d6), 5};
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0.0 && d4 - d3 >= 0.0 && d5 - d6 >= 0.0)
    return {b + (c - b) * share_of(d4 - d3, (d4 - d3) + (d5 - d6)), 4};
  return {a + ab * share_of(vb, va + vb + vc) + ac * share_of(vc, va + vb + vc), 6};
}

// Written without branches and always inlined: half of a query is this.
[[gnu::always_inline]] inline double box_distance2(const glm::dvec3& p, const glm::vec3& low,
                                                   const glm::vec3& high) {
  double sum = 0.0;
  for (int axis = 0; axis < 3; ++axis) {
    const double below = low[axis] - p[axis], above = p[axis] - high[axis];
    const double outside = below > above ? below : above;
    const double d = outside > 0.0 ? outside : 0.0;
    sum += d * d;
  }
  return sum;
}

glm::dvec3 unit_or_zero(const glm::dvec3& v) {
  const double length2 = glm::dot(v, v);
  return length2 > 0.0 ? v / std::sqrt(length2) : glm::dvec3(0.0);
}

double angle_between(const glm::dvec3& u, const glm::dvec3& v) {
  return base::exact_acos(glm::dot(unit_or_zero(u), unit_or_zero(v)));
}

}  // namespace

struct MeshIndex::Nearest {
  double distance2 = std::numeric_limits<double>::infinity();
  glm::dvec3 point{0.0};
  std::uint32_t at = 0;  // place in triangles_
  std::uint32_t id = 0;
  int feature = 6;
};

MeshIndex::MeshIndex(const Mesh& mesh) {
  const auto count = static_cast<std::uint32_t>(mesh.triangles.size());
  if (count == 0) return;
  triangles_.resize(count);
  normals_.resize(count);
  struct EdgeSide {
    std::uint32_t low, high, triangle, side;
  };
  std::vector<EdgeSide> sides;
  sides.reserve(std::size_t{count} * 3);
  std::vector<glm::dvec3> vertex_normal(mesh.vertices_lps_mm.size(), glm::dvec3(0.0));
  for (std::uint32_t t = 0; t < count; ++t) {
    Triangle& triangle = triangles_[t];
    const glm::uvec3& v = mesh.triangles[t];
    triangle.id = t;
    triangle.cut = !mesh.cut.empty() && mesh.cut[t] != 0;
    triangle.a = mesh.vertices_lps_mm[v.x];
    triangle.b = mesh.vertices_lps_mm[v.y];
    triangle.c = mesh.vertices_lps_mm[v.z];
    const glm::dvec3 corner[3] = {triangle.a, triangle.b, triangle.c};
    normals_[t].face = unit_or_zero(glm::cross(triangle.b - triangle.a, triangle.c - triangle.a));
    for (std::uint32_t i = 0; i < 3; ++i) {
      const std::uint32_t from = v[static_cast<int>(i)], to = v[static_cast<int>((i + 1) % 3)];
      sides.push_back({std::min(from, to), std::max(from, to), t, i});
      vertex_normal[from] +=
          normals_[t].face * angle_between(corner[(i + 1) % 3] - corner[i], corner[(i + 2) % 3] - corner[i]);
    }
  }
  std::sort(sides.begin(), sides.end(), [](const EdgeSide& x, const EdgeSide& y) {
    return std::tie(x.low, x.high, x.triangle, x.side) < std::tie(y.low, y.high, y.triangle, y.side);
  });
  for (std::size_t begin = 0; begin < sides.size();) {
    std::size_t end = begin;
    glm::dvec3 sum(0.0);
    while (end < sides.size() && sides[end].low == sides[begin].low && sides[end].high == sides[begin].high)
      sum += normals_[sides[end++].triangle].face;
    for (std::size_t i = begin; i < end; ++i) normals_[sides[i].triangle].edge[sides[i].side] = sum;
    begin = end;
  }
  for (std::uint32_t t = 0; t < count; ++t)
    for (int i = 0; i < 3; ++i) normals_[t].vertex[i] = vertex_normal[mesh.triangles[t][i]];

  nodes_.reserve(count);
  nodes_.emplace_back();
  build(0, 0, count);
  position_.resize(count);
  for (std::uint32_t at = 0; at < count; ++at) position_[triangles_[at].id] = at;
}

void MeshIndex::build(std::uint32_t node, std::uint32_t begin, std::uint32_t end) {
  glm::dvec3 low(std::numeric_limits<double>::infinity()), high(-std::numeric_limits<double>::infinity());
  for (std::uint32_t t = begin; t < end; ++t) {
    low = glm::min(low, glm::min(triangles_[t].a, glm::min(triangles_[t].b, triangles_[t].c)));
    high = glm::max(high, glm::max(triangles_[t].a, glm::max(triangles_[t].b, triangles_[t].c)));
  }
  nodes_[node].min_mm = glm::vec3(low);
  nodes_[node].max_mm = glm::vec3(high);
  if (end - begin <= kLeafTriangles) {
    nodes_[node].first = begin;
    nodes_[node].count = end - begin;
    return;
  }
  const glm::dvec3 extent = high - low;
  const int axis = extent.x >= extent.y && extent.x >= extent.z ? 0 : (extent.y >= extent.z ? 1 : 2);
  // A total order (ties by id), so that the tree is the same on every machine.
  std::sort(triangles_.begin() + begin, triangles_.begin() + end, [axis](const Triangle& x, const Triangle& y) {
    const double cx = x.a[axis] + x.b[axis] + x.c[axis], cy = y.a[axis] + y.b[axis] + y.c[axis];
    return cx < cy || (cx == cy && x.id < y.id);
  });
  const std::uint32_t middle = begin + (end - begin) / 2;
  const auto left = static_cast<std::uint32_t>(nodes_.size());
  nodes_[node].first = left;
  nodes_.emplace_back();
  nodes_.emplace_back();
  build(left, begin, middle);
  build(left + 1, middle, end);
}

void MeshIndex::visit(const glm::dvec3& p, bool skin_only, Nearest& nearest) const noexcept {
  struct Pending {
    std::uint32_t node;
    double distance2;
  };
  Pending stack[kMaxDepth];
  int top = 0;
  stack[top++] = {0, box_distance2(p, nodes_[0].min_mm, nodes_[0].max_mm)};
  while (top > 0) {
    const Pending pending = stack[--top];
    if (pending.distance2 > nearest.distance2) continue;
    const Node& node = nodes_[pending.node];
    if (node.count > 0) {
      for (std::uint32_t at = node.first; at < node.first + node.count; ++at) {
        const Triangle& triangle = triangles_[at];
        if (skin_only && triangle.cut) continue;
        const OnTriangle on = closest_on_triangle(p, triangle.a, triangle.b, triangle.c);
        const glm::dvec3 d = p - on.point;
        const double distance2 = glm::dot(d, d);
        if (distance2 < nearest.distance2 || (distance2 == nearest.distance2 && triangle.id < nearest.id))
          nearest = {distance2, on.point, at, triangle.id, on.feature};
      }
      continue;
    }
    const Pending left{node.first, box_distance2(p, nodes_[node.first].min_mm, nodes_[node.first].max_mm)};
    const Pending right{node.first + 1,
                        box_distance2(p, nodes_[node.first + 1].min_mm, nodes_[node.first + 1].max_mm)};
    const bool left_first = left.distance2 <= right.distance2;
    stack[top++] = left_first ? right : left;
    stack[top++] = left_first ? left : right;
  }
}

Closest MeshIndex::answer(const glm::dvec3& p, std::uint32_t hint, bool skin_only) const noexcept {
  CHECK(!triangles_.empty());
  Nearest nearest;
  const std::uint32_t at = position_[hint < position_.size() ? hint : 0];
  if (!(skin_only && triangles_[at].cut)) {
    const Triangle& first = triangles_[at];
    const OnTriangle on = closest_on_triangle(p, first.a, first.b, first.c);
    const glm::dvec3 d = p - on.point;
    nearest = {glm::dot(d, d), on.point, at, first.id, on.feature};
  }
  visit(p, skin_only, nearest);
  const Triangle& triangle = triangles_[nearest.at];
  const Normals& normals = normals_[triangle.id];
  const glm::dvec3 normal = nearest.feature == 6  ? normals.face
                            : nearest.feature < 3 ? normals.vertex[nearest.feature]
                                                  : normals.edge[nearest.feature - 3];
  const double distance = std::sqrt(nearest.distance2);
  const bool inside = glm::dot(p - nearest.point, normal) < 0.0;
  return {inside ? -distance : distance, nearest.point, triangle.id};
}

Closest MeshIndex::closest(const glm::dvec3& p, std::uint32_t hint) const noexcept {
  return answer(p, hint, false);
}

Closest MeshIndex::closest_skin(const glm::dvec3& p, std::uint32_t hint) const noexcept {
  const Closest whole = answer(p, hint, false);
  if (!triangles_[position_[whole.triangle]].cut) return whole;
  Closest skin = answer(p, hint, true);
  if (!std::isfinite(skin.distance_mm)) return whole;  // there are only caps
  skin.distance_mm = whole.distance_mm < 0.0 ? -std::abs(skin.distance_mm) : std::abs(skin.distance_mm);
  return skin;
}

std::optional<RayHit> MeshIndex::first_hit(const glm::dvec3& p, const glm::dvec3& direction,
                                           double max_mm) const noexcept {
  if (triangles_.empty()) return std::nullopt;
  const glm::dvec3 inverse = 1.0 / direction;  // ±inf on a zero component: the slab test below holds for it
  double best = max_mm;
  const Triangle* hit = nullptr;
  std::uint32_t stack[kMaxDepth];
  int top = 0;
  stack[top++] = 0;
  while (top > 0) {
    const Node& node = nodes_[stack[--top]];
    double enter = 0.0, leave = best;
    bool missed = false;
    for (int axis = 0; axis < 3 && !missed; ++axis) {
      if (direction[axis] == 0.0) {
        missed = p[axis] < node.min_mm[axis] || p[axis] > node.max_mm[axis];
        continue;
      }
      double t0 = (node.min_mm[axis] - p[axis]) * inverse[axis], t1 = (node.max_mm[axis] - p[axis]) * inverse[axis];
      if (t0 > t1) std::swap(t0, t1);
      enter = std::max(enter, t0 - 1e-9);  // a ray that grazes a flat box must not miss it by rounding
      leave = std::min(leave, t1 + 1e-9);
      missed = enter > leave;
    }
    if (missed) continue;
    if (node.count == 0) {
      stack[top++] = node.first;
      stack[top++] = node.first + 1;
      continue;
    }
    for (std::uint32_t at = node.first; at < node.first + node.count; ++at) {
      // Möller and Trumbore, J. Graphics Tools 2, 1997; borders belong to the triangle, so a closed mesh has no
      // cracks.
      const Triangle& triangle = triangles_[at];
      const glm::dvec3 e1 = triangle.b - triangle.a, e2 = triangle.c - triangle.a;
      const glm::dvec3 q = glm::cross(direction, e2);
      const double determinant = glm::dot(e1, q);
      if (determinant == 0.0) continue;
      const double f = 1.0 / determinant;
      const glm::dvec3 s = p - triangle.a;
      const double u = f * glm::dot(s, q);
      constexpr double kBorder = 1e-12;
      if (!(u >= -kBorder && u <= 1.0 + kBorder)) continue;
      const glm::dvec3 r = glm::cross(s, e1);
      const double v = f * glm::dot(direction, r);
      if (!(v >= -kBorder && u + v <= 1.0 + kBorder)) continue;
      const double t = f * glm::dot(e2, r);
      if (t > 0.0 && (t < best || (t == best && (hit == nullptr || triangle.id < hit->id)))) {
        best = t;
        hit = &triangle;
      }
    }
  }
  if (hit == nullptr) return std::nullopt;
  return RayHit{best, hit->id, hit->cut};
}

glm::dvec3 MeshIndex::normal(std::uint32_t triangle) const noexcept {
  CHECK(triangle < position_.size());
  return normals_[triangle].face;
}

bool MeshIndex::cut(std::uint32_t triangle) const noexcept {
  CHECK(triangle < position_.size());
  return triangles_[position_[triangle]].cut;
}

}  // namespace seldinger::cases
