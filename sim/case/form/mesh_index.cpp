#include "sim/case/form/mesh_index.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <glm/geometric.hpp>
#include <limits>

#include "sim/base/check.h"
#include "sim/case/form/triangle.h"

namespace seldinger::cases {
namespace {

// Every level puts at most three children aside; the tree of pairs is at most 64 deep (mesh_index_build.cpp).
constexpr int kStack = 3 * 64;
// The boxes are tried in float, where the square of more than 1e19 is infinite and the difference of two infinities
// no number, which every box, also an empty one, would seem to be near to.
constexpr double kFarthestMm = 1e15;

using Four = float __attribute__((vector_size(16)));
bool is_far(const glm::dvec3& p) {  // or no point
  return !(std::abs(p.x) <= kFarthestMm && std::abs(p.y) <= kFarthestMm && std::abs(p.z) <= kFarthestMm);
}

using FourSigns = std::int32_t __attribute__((vector_size(16)));

Four four(float value) {
  return Four{value, value, value, value};
}
Four load(const float (&values)[4]) {
  Four four_values;
  std::memcpy(&four_values, values, sizeof four_values);
  return four_values;
}
Four lesser(Four x, Four y) {
  return x < y ? x : y;
}
Four greater(Four x, Four y) {
  return x > y ? x : y;
}

// What is put aside, the most urgent on top.
struct Pending {
  std::uint32_t first, count;
  float key;
};

struct Stack {
  Pending of[kStack];
  int top = 0;

  // Those of a node's children whose key is wanted, sorted.
  template <class Node>
  void push(const Node& node, Four key, FourSigns wanted) {
    const int bottom = top;
    for (int i = 0; i < 4; ++i) {
      if (wanted[i] == 0) continue;
      int place = top++;
      for (; place > bottom && of[place - 1].key < key[i]; --place) of[place] = of[place - 1];
      of[place] = {node.first[i], node.count[i], key[i]};
    }
  }
};

}  // namespace

struct MeshIndex::Nearest {
  double distance2 = std::numeric_limits<double>::infinity();
  glm::dvec3 point{0.0};
  std::uint32_t at = 0;  // place in triangles_
  std::uint32_t id = 0;
  int feature = 6;
};

// How far a coordinate of p, less one of the mesh, can be off in float.
double MeshIndex::box_error_mm(const glm::dvec3& p) const noexcept {
  const double largest = std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z), reach_mm_});
  return 2.5e-7 * largest;  // two roundings of 2⁻²⁴ each, of at most 2 · largest
}

void MeshIndex::visit(const glm::dvec3& p, bool skin_only, Nearest& nearest) const noexcept {
  const auto error = static_cast<float>(box_error_mm(p));
  const glm::vec3 at(p);
  Stack stack;
  Pending next{0, 0, 0.0F};
  for (;;) {
    if (next.count == 0) {
      const Node& node = nodes_[next.first];
      Four sum = four(0.0F);
      for (int axis = 0; axis < 3; ++axis) {
        const Four below = load(node.low[axis]) - four(at[axis]), above = four(at[axis]) - load(node.high[axis]);
        const Four outside = greater(greater(below, above) - four(error), four(0.0F));
        sum += outside * outside;
      }
      sum *= four(1.0F - 1e-6F);  // never more than the true distance squared
      const double most = nearest.distance2 * (1.0 + 1e-6);
      stack.push(node, sum, sum <= four(most < 1e38 ? static_cast<float>(most) : 1e38F));
    }
    for (std::uint32_t i = next.first; i < next.first + next.count; ++i) {
      const Triangle& triangle = triangles_[i];
      if (skin_only && triangle.cut) continue;
      const OnTriangle on = closest_on_triangle(p, triangle.a, triangle.b, triangle.c, triangle.thin);
      const glm::dvec3 d = p - on.point;
      const double distance2 = glm::dot(d, d);
      if (distance2 < nearest.distance2 || (distance2 == nearest.distance2 && triangle.id < nearest.id))
        nearest = {distance2, on.point, i, triangle.id, on.feature};
    }
    do {
      if (stack.top == 0) return;
      next = stack.of[--stack.top];
    } while (static_cast<double>(next.key) > nearest.distance2);
  }
}

Closest MeshIndex::answer(const glm::dvec3& p, std::uint32_t hint, bool skin_only) const noexcept {
  CHECK(!triangles_.empty());
  if (is_far(p)) return far_answer(p, hint, skin_only);
  Nearest nearest;
  const std::uint32_t at = position_[hint < position_.size() ? hint : 0];
  if (!(skin_only && triangles_[at].cut)) {
    const Triangle& first = triangles_[at];
    const OnTriangle on = closest_on_triangle(p, first.a, first.b, first.c, first.thin);
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

// Beyond where the boxes can be asked: the triangle nearest to the place on the way there, the distance to p
// itself.
Closest MeshIndex::far_answer(const glm::dvec3& p, std::uint32_t hint, bool skin_only) const noexcept {
  glm::dvec3 near(0.0);
  for (int axis = 0; axis < 3; ++axis)
    if (!std::isnan(p[axis])) near[axis] = std::clamp(p[axis], -kFarthestMm, kFarthestMm);
  Closest found = answer(near, hint, skin_only);
  // Not of three at once: g++ 12's divides infinity by itself.
  const double distance =
      std::hypot(std::hypot(p.x - found.point_lps_mm.x, p.y - found.point_lps_mm.y), p.z - found.point_lps_mm.z);
  const bool is_point = !std::isnan(p.x) && !std::isnan(p.y) && !std::isnan(p.z);
  found.distance_mm = is_point ? std::copysign(distance, found.distance_mm) : std::nan("");
  return found;
}

Closest MeshIndex::closest(const glm::dvec3& p, std::uint32_t hint) const noexcept {
  return answer(p, hint, false);
}

Closest MeshIndex::closest_skin(const glm::dvec3& p, std::uint32_t hint) const noexcept {
  const Closest whole = answer(p, hint, false);
  if (!triangles_[position_[whole.triangle]].cut) return whole;
  Closest skin = answer(p, hint, true);
  if (triangles_[position_[skin.triangle]].cut) return whole;  // there are only caps
  skin.distance_mm = whole.distance_mm < 0.0 ? -std::abs(skin.distance_mm) : std::abs(skin.distance_mm);
  return skin;
}

struct MeshIndex::Ray {
  Ray(const glm::dvec3& p, const glm::dvec3& along, double margin_mm) : margin(static_cast<float>(margin_mm)) {
    for (int axis = 0; axis < 3; ++axis) {
      from[axis] = static_cast<float>(p[axis]);
      // A component of 0 gets a huge slope, never an infinite one: 0 · ∞ would be no number.
      const auto sign = std::copysign(1.0, along[axis]);
      slope[axis] = static_cast<float>(std::abs(along[axis]) > 1e-15 ? 1.0 / along[axis] : sign * 1e15);
    }
  }
  glm::vec3 from, slope;
  float margin;
};

template <class Visit>
void MeshIndex::walk(const Ray& ray, double& best_mm, Visit visit) const noexcept {
  constexpr float kWider = 1.0F + 1e-6F;  // what dividing and multiplying can be off
  Stack stack;
  Pending next{0, 0, 0.0F};
  for (;;) {
    if (next.count == 0) {
      const Node& node = nodes_[next.first];
      Four enter = four(0.0F), leave = four(static_cast<float>(best_mm) * kWider);
      for (int axis = 0; axis < 3; ++axis) {
        // By the sign, not by which is less: so an empty box is entered nowhere.
        const bool up = ray.slope[axis] > 0.0F;
        const Four slope = four(ray.slope[axis]), from = four(ray.from[axis]);
        const Four margin = four(up ? ray.margin : -ray.margin);
        enter = greater(enter, (load(up ? node.low[axis] : node.high[axis]) - from - margin) * slope);
        leave = lesser(leave, (load(up ? node.high[axis] : node.low[axis]) - from + margin) * slope);
      }
      enter *= four(2.0F - kWider);
      stack.push(node, enter, enter <= leave * four(kWider));
    }
    for (std::uint32_t i = next.first; i < next.first + next.count; ++i) visit(triangles_[i]);
    do {
      if (stack.top == 0) return;
      next = stack.of[--stack.top];
    } while (static_cast<double>(next.key) > best_mm);
  }
}

std::optional<RayHit> MeshIndex::first_hit(const glm::dvec3& p, const glm::dvec3& direction,
                                           double max_mm) const noexcept {
  if (triangles_.empty() || is_far(p) || !(max_mm > 0.0)) return std::nullopt;
  double best = max_mm;
  const Triangle* hit = nullptr;
  walk(Ray(p, direction, box_error_mm(p)), best, [&](const Triangle& triangle) {
    // Möller and Trumbore, J. Graphics Tools 2, 1997; borders belong to the triangle, so a closed mesh has no
    // cracks.
    const glm::dvec3 a(triangle.a), e1 = glm::dvec3(triangle.b) - a, e2 = glm::dvec3(triangle.c) - a;
    const glm::dvec3 q = glm::cross(direction, e2);
    const double determinant = glm::dot(e1, q);
    if (determinant == 0.0) return;
    const double f = 1.0 / determinant;
    const glm::dvec3 s = p - a;
    const double u = f * glm::dot(s, q);
    constexpr double kBorder = 1e-12;
    if (!(u >= -kBorder && u <= 1.0 + kBorder)) return;
    const glm::dvec3 r = glm::cross(s, e1);
    const double v = f * glm::dot(direction, r);
    if (!(v >= -kBorder && u + v <= 1.0 + kBorder)) return;
    const double t = f * glm::dot(e2, r);
    if (t > 0.0 && (t < best || (t == best && (hit == nullptr || triangle.id < hit->id)))) {
      best = t;
      hit = &triangle;
    }
  });
  if (hit == nullptr) return std::nullopt;
  return RayHit{best, hit->id, hit->cut};
}

std::optional<BallTouch> MeshIndex::first_touch(const glm::dvec3& p, const glm::dvec3& direction, double length_mm,
                                                double radius_mm, double slack_mm,
                                                std::uint32_t hint) const noexcept {
  CHECK(slack_mm > 0.0 && slack_mm < radius_mm);
  if (triangles_.empty() || is_far(p) || std::isnan(length_mm)) return std::nullopt;
  const double least_mm = radius_mm - slack_mm, near_mm = 0.25 * slack_mm;
  double best = length_mm;  // where the nearest triangle so far comes nearer than least_mm
  std::optional<BallTouch> touch;
  const auto visit = [&](const Triangle& triangle) {
    const glm::dvec3 a(triangle.a), b(triangle.b), c(triangle.c);
    // The distance to a triangle, a convex body, is a convex function of the way: its tangent reaches any value
    // before it does, so steps to where the tangent does (Newton's) never go too far.
    BallTouch met{-1.0, glm::dvec3(0.0), 0.0, triangle.id};
    double travel = 0.0;
    for (;;) {
      const glm::dvec3 at = p + direction * travel;
      const glm::dvec3 from = at - closest_on_triangle(at, a, b, c, triangle.thin).point;
      const double distance = std::sqrt(glm::dot(from, from));
      const double closing = -glm::dot(from, direction);  // times distance
      if (!(closing > 1e-10 * distance) || (distance - least_mm) * distance >= (best - travel) * closing) return;
      if (met.travel_mm < 0.0 && distance <= radius_mm + near_mm) {
        met.travel_mm = travel;
        met.normal = from / distance;
        met.distance_mm = distance;
      }
      if (distance <= least_mm + near_mm) {
        best = travel;
        touch = met;
        return;
      }
      travel += (distance - (met.travel_mm < 0.0 ? radius_mm : least_mm)) * distance / closing;
    }
  };
  visit(triangles_[position_[hint < position_.size() ? hint : 0]]);
  walk(Ray(p, direction, radius_mm + box_error_mm(p)), best, visit);
  return touch;
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
