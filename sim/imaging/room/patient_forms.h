// The patient as the room shows him: skin with fewer triangles than touch needs, where the CT ends, drapes over
// these ends.
#pragma once

#include <cstddef>

#include "sim/case/case.h"
#include "sim/imaging/room/room_mesh.h"

namespace seldinger::imaging {

struct RoomFrame;

struct PatientForms {
  RoomMesh skin, cut_ends;  // LPS
  RoomMesh drapes;
};

// The skin by clusters of vertices (Rossignac and Borrel, 1993), as many as leave about `most_triangles`; normals
// are those of all its triangles. What of the light from all round reaches a vertex is found by rays where the case
// has a skin index.
PatientForms patient_forms(const cases::Case& scene, const RoomFrame& frame, std::size_t most_triangles);

}  // namespace seldinger::imaging
