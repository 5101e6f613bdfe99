// What an organ that is named makes of the classes of its voxels, so that ultrasound and touch know it.
#pragma once

#include <optional>
#include <vector>

#include "sim/volume/organs/find_organs.h"

namespace seldinger::volume {

// Where liver, spleen or a kidney is named, soft tissue becomes its class, in spleen and kidneys vessel too, since
// HU tell what is full of contrast there from no vessel; a liver is never so bright (Bae, Radiology 2010;256:32),
// so that a vessel in it stays one. Soft tissue of aorta and vena cava becomes vessel, of bladder and gallbladder
// fluid. Fat, gas, bone, cysts and metal within an organ stay. The organ's edge lies between the voxels of its
// grid. Found organs and the phase of contrast are the same for the classes that are made. Classes: as many as
// voxels (CHECK).
void mark_organs(const Volume& volume, const Organs& organs, std::vector<TissueClass>& classes);

// Whether a voxel that is stored as this class may lie in that organ: it is the organ's, or one that mark_organs
// leaves as it is there. Soft tissue of a case stored before its organ was found is not.
bool may_lie_in(FoundOrgan organ, TissueClass tissue);

// What a new case stores, and a scene of a CT shows: a label with a known name decides (find_tissue.h); without
// labels organs are looked for.
struct MarkedClasses {
  std::vector<TissueClass> classes;
  std::optional<Organs> organs;  // nothing: labels decided
};
MarkedClasses marked_classes(const Volume& volume, const LabelMap* labels);
std::vector<TissueClass> classes_with_organs(const Volume& volume, const LabelMap* labels);

}  // namespace seldinger::volume
