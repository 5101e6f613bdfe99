// Lungs by their texture and side, vertebrae around blocks of bone, ribs as the bone that lies on lung. Inside
// sim/volume/organs only.
#pragma once

#include <glm/vec2.hpp>
#include <vector>

#include "sim/volume/organs/lattice.h"
#include "sim/volume/organs/spine.h"

namespace seldinger::volume {

// middle_mm: as middle_of_back, not empty.
std::vector<Part> find_lungs(const OrganGrid& grid, const std::vector<glm::dvec2>& middle_mm);
std::vector<Part> find_vertebrae(const OrganGrid& grid, const Spine& spine);
std::vector<Part> find_ribs(const OrganGrid& grid, const Spine& spine, const std::vector<Part>& lungs);

}  // namespace seldinger::volume
