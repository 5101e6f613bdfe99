// The steps of tissue_classes, in their order. Each takes classes so far (air outside the body, soft_tissue inside,
// then what the steps before it found) and refines them. Inside sim/volume/tissue only.
#pragma once

#include <cstdint>
#include <vector>

#include "sim/volume/classes.h"

namespace seldinger::volume {

void mark_air_spaces(const Volume& volume, std::vector<TissueClass>& classes);   // gas, lung
void mark_hard_tissue(const Volume& volume, std::vector<TissueClass>& classes);  // bone, metal, vessel: rule 1
// The same by rule 2, and each voxel's share of bone in 255ths (sized by it).
void mark_bone_by_shape(const Volume& volume, std::vector<TissueClass>& classes, std::vector<std::uint8_t>& bone);
void mark_soft_tissue(const Volume& volume, std::vector<TissueClass>& classes);  // fat, fluid

// Holes in bone: marrow that bone surrounds in most directions of a slice, and pores that it surrounds in all.
void fill_marrow(const Volume& volume, std::vector<TissueClass>& classes);

// Of soft tissue, from differences `apart` voxels apart along x, where noise is nearly independent: their `share`
// smallest are below `in_sd` sd, as those of a normal distribution are.
struct NoiseFrom {
  int apart = 3;
  double share = 0.5, in_sd = 0.954;
};
double noise_sd_hu(const Volume& volume, const std::vector<TissueClass>& classes, NoiseFrom from = {});

// Mean HU over [1 2 1] x [1 2 1] / 16 in a slice, its edge repeated: halves noise and keeps a rib's cortex.
void smooth_slice(const Volume& volume, int k, std::vector<std::int16_t>& smooth);

}  // namespace seldinger::volume
