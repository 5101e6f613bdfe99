// The steps of tissue_classes, in their order. Each takes classes so far (air outside the body, soft_tissue inside,
// then what the steps before it found) and refines them. Inside sim/volume only.
#pragma once

#include <vector>

#include "sim/volume/classes.h"

namespace seldinger::volume {

void mark_air_spaces(const Volume& volume, std::vector<TissueClass>& classes);   // gas, lung
void mark_hard_tissue(const Volume& volume, std::vector<TissueClass>& classes);  // bone, metal, vessel
void mark_soft_tissue(const Volume& volume, std::vector<TissueClass>& classes);  // fat, fluid

// Mean HU over [1 2 1] x [1 2 1] / 16 in a slice, its edge repeated: halves noise and keeps a rib's cortex.
void smooth_slice(const Volume& volume, int k, std::vector<std::int16_t>& smooth);

}  // namespace seldinger::volume
