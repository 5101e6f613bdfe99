// A mesh as binary glTF 2.0 (Khronos, ISO/IEC 12113), for browsers and other programs.
#pragma once

#include <cstddef>
#include <vector>

#include "sim/case/form/mesh.h"

namespace seldinger::casedb {

// One mesh of up to two parts: "skin", and "cut" where the volume ends. Vertices as they are, LPS in mm; the node
// turns them into glTF's frame: metres, x to the patient's left, y to the head, z to the front. Normals are
// area-weighted means of the triangles around. Nothing else: no title, no id. CHECKs that there is a triangle.
std::vector<std::byte> glb_of(const cases::Mesh& mesh);

}  // namespace seldinger::casedb
