// Aorta and vena cava of a CT with contrast: tubes of one level along the spine. Inside sim/volume/organs only.
#pragma once

#include <vector>

#include "sim/volume/organs/lattice.h"
#include "sim/volume/organs/spine.h"

namespace seldinger::volume {

std::vector<Part> find_great_vessels(const OrganGrid& grid, const Spine& spine);

}  // namespace seldinger::volume
