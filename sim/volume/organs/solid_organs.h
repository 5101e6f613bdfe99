// Liver, spleen, kidneys and bladder, and the gallbladder beside a liver: even pieces of one level. Inside
// sim/volume/organs only.
#pragma once

#include <glm/vec2.hpp>
#include <optional>
#include <vector>

#include "sim/volume/organs/lattice.h"

namespace seldinger::volume {

// middle_mm: as middle_of_back, not empty.
std::vector<Part> find_solid_organs(const OrganGrid& grid, const std::vector<glm::dvec2>& middle_mm);
// Beside the liver that is named among `solid`; nothing where none is.
std::optional<Part> find_gallbladder(const OrganGrid& grid, const std::vector<glm::dvec2>& middle_mm,
                                     const std::vector<Part>& solid);

}  // namespace seldinger::volume
