// What each voxel is: its class, and how much of it is bone. Import computes them once and keeps them beside the
// volume; scenes when they are built. See docs/decisions/0055.
#pragma once

#include <cstdint>
#include <vector>

#include "sim/volume/classes.h"

namespace seldinger::volume {

struct Tissue {
  std::vector<TissueClass> classes;  // one per voxel, in the volume's order
  std::vector<std::uint8_t>
      bone_share;  // 0 to 255: of the voxel's inside; a rib in a coarse voxel fills part of it
};

// A label with a known name decides; elsewhere HU, shape, place and neighbours do. Labels: as many as voxels
// (CHECK). Same input, same bytes; one thread.
Tissue find_tissue(const Volume& volume, const LabelMap* labels = nullptr);

// A label with a known name (tissue_of_name) is the class of its voxels. Labels, and shares where given: as many as
// classes (CHECK).
void let_labels_win(const LabelMap& labels, std::vector<TissueClass>& classes,
                    std::vector<std::uint8_t>* bone_share = nullptr);

// The classes alone.
std::vector<TissueClass> tissue_classes(const Volume& volume, const LabelMap* labels = nullptr);

// As docs/decisions/0012 told them: what a case from before schema 3, which has no classes stored, was practised
// on.
std::vector<TissueClass> tissue_classes_by_rule_1(const Volume& volume, const LabelMap* labels = nullptr);

}  // namespace seldinger::volume
