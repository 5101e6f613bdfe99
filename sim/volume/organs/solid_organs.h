// Liver, spleen, kidneys, gallbladder and bladder: even pieces of one level. Inside sim/volume/organs only.
#pragma once

#include <glm/vec2.hpp>
#include <vector>

#include "sim/volume/organs/lattice.h"

namespace seldinger::volume {

// middle_mm: as middle_of_back, not empty.
std::vector<Part> find_solid_organs(const OrganGrid& grid, const std::vector<glm::dvec2>& middle_mm);

}  // namespace seldinger::volume
