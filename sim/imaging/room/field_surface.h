// A surface of equal value in a grid, by surface nets (Gibson, 1998): one vertex a cell, between the crossings on
// its edges. For what is shown inside a patient; the skin is import's.
#pragma once

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "sim/case/structure.h"
#include "sim/imaging/room/room_mesh.h"
#include "sim/volume/volume.h"

namespace seldinger::imaging {

struct Field {
  glm::ivec3 size{0};         // nodes, i fastest
  std::vector<float> values;  // size.x · size.y · size.z
  glm::dmat4 lps_from_node{1.0};
};

// Inside is above `iso`. Closed where the grid ends above it.
RoomMesh field_surface(const Field& field, float iso);

// Every few voxels of a volume, about `spacing_mm` apart.
Field hu_field(const volume::Volume& volume, double spacing_mm);

// A structure, in LPS; empty when its shape is.
RoomMesh form_of(const cases::Shape& shape);

}  // namespace seldinger::imaging
