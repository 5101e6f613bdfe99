// Whether triangles enclose a space, and how much.
#pragma once

#include "sim/case/form/mesh.h"

namespace seldinger::casedb {

// Every edge belongs to exactly two triangles, which run along it in opposite directions.
bool is_closed(const cases::Mesh& mesh);

// Enclosed space; negative when the triangles face inwards (sum of signed tetrahedra, divergence theorem).
double signed_volume_mm3(const cases::Mesh& mesh);

// Only the connected piece with the most triangles; unused vertices go. `cut` is not carried over.
cases::Mesh largest_piece(const cases::Mesh& mesh);

}  // namespace seldinger::casedb
