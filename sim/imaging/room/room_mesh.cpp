#include "sim/imaging/room/room_mesh.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_inverse.hpp>
#include <numbers>

#include "sim/base/check.h"

namespace seldinger::imaging {
namespace {

std::uint8_t byte_of(double share) {
  return static_cast<std::uint8_t>(std::lround(255.0 * std::clamp(share, 0.0, 1.0)));
}

glm::dvec3 unit_or(const glm::dvec3& v, const glm::dvec3& otherwise) {
  const double length = glm::length(v);
  return length > 0.0 ? v / length : otherwise;
}

void add_face(RoomMesh& mesh, std::initializer_list<glm::dvec3> corners, const RoomColour& paint) {
  const auto* at = corners.begin();
  const glm::dvec3 normal = unit_or(glm::cross(at[1] - at[0], at[2] - at[0]), {0.0, 0.0, 1.0});
  std::uint32_t first = 0, before = 0, i = 0;
  for (const glm::dvec3& corner : corners) {
    const std::uint32_t now = mesh.add(corner, normal, paint);
    if (i == 0) first = now;
    if (i > 1) mesh.triangles.push_back({first, before, now});
    before = now;
    ++i;
  }
}

}  // namespace

std::uint32_t RoomMesh::add(const glm::dvec3& place_mm, const glm::dvec3& normal, const RoomColour& paint,
                            double shade) {
  vertices.push_back({glm::vec3(place_mm),
                      glm::vec3(normal),
                      {byte_of(static_cast<double>(paint.r)), byte_of(static_cast<double>(paint.g)),
                       byte_of(static_cast<double>(paint.b)), byte_of(shade)}});
  return static_cast<std::uint32_t>(vertices.size() - 1);
}

void RoomMesh::append(const RoomMesh& other, const glm::dmat4& here_from_other) {
  const auto base = static_cast<std::uint32_t>(vertices.size());
  const glm::dmat3 turn = glm::inverseTranspose(glm::dmat3(here_from_other));
  for (gpu::Vertex vertex : other.vertices) {
    vertex.place_mm = glm::vec3(here_from_other * glm::dvec4(glm::dvec3(vertex.place_mm), 1.0));
    vertex.normal = glm::vec3(glm::normalize(turn * glm::dvec3(vertex.normal)));
    vertices.push_back(vertex);
  }
  for (const glm::uvec3& triangle : other.triangles) triangles.push_back(triangle + base);
}

RoomMesh turned(std::span<const TurnedPart> parts, int sides) {
  CHECK(sides >= 3);
  RoomMesh mesh;
  for (const TurnedPart& part : parts) {
    const glm::dvec2 way = part.to_mm - part.from_mm;
    const glm::dvec2 out = glm::normalize(glm::dvec2(way.y, -way.x));
    std::uint32_t first = 0;
    for (int i = 0; i <= sides; ++i) {
      const double angle = 2.0 * std::numbers::pi * i / sides;
      const glm::dvec3 round(std::cos(angle), std::sin(angle), 0.0);
      const glm::dvec3 normal = out.x * round + glm::dvec3(0.0, 0.0, out.y);
      const std::uint32_t low =
          mesh.add(part.from_mm.x * round + glm::dvec3(0.0, 0.0, part.from_mm.y), normal, part.paint);
      mesh.add(part.to_mm.x * round + glm::dvec3(0.0, 0.0, part.to_mm.y), normal, part.paint);
      if (i == 0) {
        first = low;
        continue;
      }
      const std::uint32_t before = first + 2 * static_cast<std::uint32_t>(i - 1);
      if (part.from_mm.x > 0.0) mesh.triangles.push_back({before, low, before + 1});
      if (part.to_mm.x > 0.0) mesh.triangles.push_back({before + 1, low, low + 1});
    }
  }
  return mesh;
}

RoomMesh unit_sphere(int rings) {
  CHECK(rings >= 2);
  RoomMesh mesh;
  const int sides = 2 * rings;
  for (int ring = 0; ring <= rings; ++ring)
    for (int side = 0; side <= sides; ++side) {
      const double down = std::numbers::pi * ring / rings, round = 2.0 * std::numbers::pi * side / sides;
      const glm::dvec3 place(std::sin(down) * std::cos(round), std::sin(down) * std::sin(round), std::cos(down));
      mesh.add(place, place);
    }
  const auto at = [&](int ring, int side) { return static_cast<std::uint32_t>(ring * (sides + 1) + side); };
  for (int ring = 0; ring < rings; ++ring)
    for (int side = 0; side < sides; ++side) {
      if (ring > 0) mesh.triangles.push_back({at(ring, side), at(ring + 1, side), at(ring, side + 1)});
      if (ring < rings - 1)
        mesh.triangles.push_back({at(ring, side + 1), at(ring + 1, side), at(ring + 1, side + 1)});
    }
  return mesh;
}

RoomMesh box(const glm::dvec3& low_mm, const glm::dvec3& high_mm, double bevel_mm, const RoomColour& paint) {
  const glm::dvec3 middle = 0.5 * (low_mm + high_mm), half_mm = 0.5 * (high_mm - low_mm);
  CHECK(half_mm.x > bevel_mm && half_mm.y > bevel_mm && half_mm.z > bevel_mm && bevel_mm >= 0.0);
  const glm::dvec3 inner = half_mm - bevel_mm;
  RoomMesh mesh;
  // A corner of the box as the face across `axis` has it: there it lies outside, along the others inside.
  const auto corner = [&](int axis, glm::dvec3 signs) {
    glm::dvec3 place = signs * inner;
    place[axis] = signs[axis] * half_mm[axis];
    return middle + place;
  };
  for (int axis = 0; axis < 3; ++axis) {
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    for (const double sign : {-1.0, 1.0}) {
      glm::dvec3 s(0.0);
      s[axis] = sign;
      const auto at = [&](double a, double b) {
        s[u] = a;
        s[v] = b;
        return corner(axis, s);
      };
      if (sign > 0.0)
        add_face(mesh, {at(-1, -1), at(1, -1), at(1, 1), at(-1, 1)}, paint);
      else
        add_face(mesh, {at(-1, -1), at(-1, 1), at(1, 1), at(1, -1)}, paint);
    }
    if (bevel_mm == 0.0) continue;
    // The edges along `axis`, between the faces across u and v.
    for (const double a : {-1.0, 1.0})
      for (const double b : {-1.0, 1.0}) {
        glm::dvec3 near(0.0), far(0.0);
        near[u] = far[u] = a;
        near[v] = far[v] = b;
        near[axis] = -1.0;
        far[axis] = 1.0;
        if (a * b > 0.0)
          add_face(mesh, {corner(u, near), corner(v, near), corner(v, far), corner(u, far)}, paint);
        else
          add_face(mesh, {corner(u, near), corner(u, far), corner(v, far), corner(v, near)}, paint);
      }
  }
  if (bevel_mm > 0.0)
    for (const double a : {-1.0, 1.0})
      for (const double b : {-1.0, 1.0})
        for (const double c : {-1.0, 1.0}) {
          const glm::dvec3 s(a, b, c);
          if (a * b * c > 0.0)
            add_face(mesh, {corner(0, s), corner(1, s), corner(2, s)}, paint);
          else
            add_face(mesh, {corner(0, s), corner(2, s), corner(1, s)}, paint);
        }
  return mesh;
}

RoomMesh swept(std::span<const glm::dvec3> points_mm, double radius_mm, int sides, const RoomColour& paint) {
  CHECK(points_mm.size() >= 2 && sides >= 3);
  RoomMesh mesh;
  const std::size_t n = points_mm.size();
  glm::dvec3 across(0.0);
  const auto ring = [&](const glm::dvec3& place, const glm::dvec3& along, double radius, double forwards) {
    const glm::dvec3 v = glm::cross(along, across);
    for (int i = 0; i <= sides; ++i) {
      const double angle = 2.0 * std::numbers::pi * i / sides;
      const glm::dvec3 out = std::cos(angle) * across + std::sin(angle) * v;
      mesh.add(place + radius * out, glm::normalize(out * std::max(radius / radius_mm, 1e-6) + forwards * along),
               paint);
    }
  };
  for (std::size_t i = 0; i < n; ++i) {
    const glm::dvec3 before = i > 0 ? points_mm[i] - points_mm[i - 1] : points_mm[1] - points_mm[0];
    const glm::dvec3 after = i + 1 < n ? points_mm[i + 1] - points_mm[i] : before;
    const glm::dvec3 along = unit_or(unit_or(before, after) + unit_or(after, before), {0.0, 0.0, 1.0});
    // The ring before is carried on, so that the tube does not twist.
    across -= along * glm::dot(along, across);
    if (glm::length(across) < 1e-6)
      across = glm::cross(along, std::abs(along.x) < 0.7 ? glm::dvec3(1.0, 0.0, 0.0) : glm::dvec3(0.0, 1.0, 0.0));
    across = glm::normalize(across);
    if (i == 0) {
      ring(points_mm[i] - along * radius_mm, along, 0.0, -1.0);
      ring(points_mm[i] - along * (0.7 * radius_mm), along, 0.7 * radius_mm, -0.7);
    }
    ring(points_mm[i], along, radius_mm, 0.0);
    if (i + 1 == n) {
      ring(points_mm[i] + along * (0.7 * radius_mm), along, 0.7 * radius_mm, 0.7);
      ring(points_mm[i] + along * radius_mm, along, 0.0, 1.0);
    }
  }
  const auto rings = static_cast<std::uint32_t>(n + 4), wide = static_cast<std::uint32_t>(sides + 1);
  for (std::uint32_t r = 0; r + 1 < rings; ++r)
    for (std::uint32_t i = 0; i + 1 < wide; ++i) {
      const std::uint32_t a = r * wide + i;
      if (r > 0) mesh.triangles.push_back({a, a + 1, a + wide});
      if (r + 2 < rings) mesh.triangles.push_back({a + 1, a + wide + 1, a + wide});
    }
  return mesh;
}

void make_smooth(RoomMesh& mesh) {
  std::vector<glm::dvec3> normals(mesh.vertices.size(), glm::dvec3(0.0));
  for (const glm::uvec3& t : mesh.triangles) {
    const glm::dvec3 a(mesh.vertices[t.x].place_mm), b(mesh.vertices[t.y].place_mm), c(mesh.vertices[t.z].place_mm);
    const glm::dvec3 twice_area = glm::cross(b - a, c - a);
    for (int i = 0; i < 3; ++i) normals[t[i]] += twice_area;
  }
  for (std::size_t i = 0; i < normals.size(); ++i)
    mesh.vertices[i].normal = glm::vec3(unit_or(normals[i], {0.0, 0.0, 1.0}));
}

}  // namespace seldinger::imaging
