// A triangle mesh as plain data: the patient's skin.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "sim/base/result.h"

namespace seldinger::cases {

struct Mesh {
  std::vector<glm::vec3> vertices_lps_mm;  // nv
  std::vector<glm::uvec3> triangles;       // nt; counter-clockwise seen from outside
  std::vector<std::uint8_t> cut;           // nt; 1 = cap at the volume's end, which cannot be punctured
};

// The mesh as the library stores it, and back. Refused (`damaged`) when sizes, indices or coordinates are not
// sound.
std::vector<std::byte> bytes_from_mesh(const Mesh& mesh);
base::Result<Mesh> mesh_from_bytes(std::span<const std::byte> bytes);

}  // namespace seldinger::cases
