// Triangles of the room's things, and the forms they are made of: turned, boxed, swept along a line.
#pragma once

#include <cstdint>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "sim/gpu/triangles.h"

namespace seldinger::imaging {

// Colours are linear light, 0 to 1.
using RoomColour = glm::vec3;

struct RoomMesh {
  std::vector<gpu::Vertex> vertices;
  std::vector<glm::uvec3> triangles;  // counter-clockwise seen from outside

  // A vertex; its index. `shade` 0 to 1: how much of the light from all round reaches it.
  std::uint32_t add(const glm::dvec3& place_mm, const glm::dvec3& normal,
                    const RoomColour& paint = RoomColour(1.0F), double shade = 1.0);
  void append(const RoomMesh& other, const glm::dmat4& here_from_other);
};

// A point of a profile that is turned about the z axis: radius and height, mm.
struct TurnedPart {
  glm::dvec2 from_mm{0.0}, to_mm{0.0};  // (radius, z), z rising: the outside is on the right
  RoomColour paint{1.0F};
};
// Each part's edges are sharp; parts of a round profile are close together.
RoomMesh turned(std::span<const TurnedPart> parts, int sides);

RoomMesh unit_sphere(int rings);  // radius 1 about the origin

// Axis-aligned, its edges bevelled by `bevel_mm`.
RoomMesh box(const glm::dvec3& low_mm, const glm::dvec3& high_mm, double bevel_mm,
             const RoomColour& paint = RoomColour(1.0F));

// A round tube along points (two at least, no two the same), with round-looking closed ends.
RoomMesh swept(std::span<const glm::dvec3> points_mm, double radius_mm, int sides,
               const RoomColour& paint = RoomColour(1.0F));

// Normals from the triangles, weighted by their area, in place of what is there.
void make_smooth(RoomMesh& mesh);

}  // namespace seldinger::imaging
