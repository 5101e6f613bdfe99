// The closest point of a triangle, however thin it is.
#pragma once

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace seldinger::cases {

struct OnTriangle {
  glm::dvec3 point;
  int feature;  // 0..2 vertices a b c, 3..5 edges ab bc ca, 6 face
};

// Shares along an edge; an edge without length has none.
inline double share_of(double part, double whole) noexcept {
  return whole > 0.0 ? part / whole : 0.0;
}

// Without area to speak of: its height is below a millionth of its longest edge, where the formulas below would
// divide noise by noise.
inline bool is_thin(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) noexcept {
  const glm::dvec3 ab = b - a, ac = c - a, bc = c - b, normal = glm::cross(ab, ac);
  const double longest2 = glm::max(glm::dot(ab, ab), glm::max(glm::dot(ac, ac), glm::dot(bc, bc)));
  return !(glm::dot(normal, normal) > 1e-12 * longest2 * longest2);
}

// By Voronoi regions (Ericson, Real-Time Collision Detection, 2005, §5.1.5). Not for thin triangles.
inline OnTriangle closest_on_face(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b,
                                  const glm::dvec3& c) noexcept {
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

// Of the three edges: what a thin triangle is.
inline OnTriangle closest_on_edges(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b,
                                   const glm::dvec3& c) noexcept {
  const glm::dvec3 corner[3] = {a, b, c};
  OnTriangle best{a, 0};
  double best2 = glm::dot(p - a, p - a);
  for (int i = 0; i < 3; ++i) {
    const glm::dvec3 edge = corner[(i + 1) % 3] - corner[i];
    const double share = share_of(glm::dot(p - corner[i], edge), glm::dot(edge, edge));
    const double inside = glm::clamp(share, 0.0, 1.0);
    const glm::dvec3 point = corner[i] + edge * inside;
    const double distance2 = glm::dot(p - point, p - point);
    if (distance2 < best2) {
      best = {point, share <= 0.0 ? i : share >= 1.0 ? (i + 1) % 3 : 3 + i};
      best2 = distance2;
    }
  }
  return best;
}

inline OnTriangle closest_on_triangle(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b,
                                      const glm::dvec3& c, bool thin) noexcept {
  return thin ? closest_on_edges(p, a, b, c) : closest_on_face(p, a, b, c);
}

}  // namespace seldinger::cases
