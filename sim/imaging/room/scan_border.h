// Where the picture under a probe lies, for who is helped to see it in the room.
#pragma once

#include <glm/vec3.hpp>
#include <vector>

#include "sim/case/case.h"
#include "sim/case/console.h"

namespace seldinger::imaging {

// The picture's border in the probe's frame, x lateral, y axial × lateral, z axial, mm: points in turn, the first
// once more at the end. As the console stands; each arc of a curved probe in so many pieces (≥ 1).
std::vector<glm::dvec3> scan_border(const cases::Picture& picture, const cases::ConsoleSetting& console,
                                    int pieces);

}  // namespace seldinger::imaging
