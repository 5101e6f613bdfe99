// A case's skin for the replay in a browser.
#pragma once

#include <string>

#include "sim/case/form/mesh.h"

namespace seldinger::web {

inline constexpr std::size_t kMostSkinVertices = 2'000;

// A coarse net of it, to look at and to measure nothing by: vertices of a cell become one, at their mean, in LPS
// and whole millimetres; cells as large as kMostSkinVertices asks. Without what closes the volume's ends. Three
// numbers a vertex, three indices a triangle, in one row each.
std::string skin_json(const cases::Mesh& skin);

}  // namespace seldinger::web
