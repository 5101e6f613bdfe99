// A CT's slices side by side, head first, tinted by what each voxel was told to be.
#pragma once

#include <span>

#include "app/replay/canvas.h"
#include "sim/volume/organs/find_organs.h"
#include "sim/volume/tissue/tissue_told.h"

namespace seldinger::app {

constexpr int kSheetSlices = 20;

// Organs over classes over grey (−160 to 240 HU), the patient's right at the left; below it which colour means
// what. Classes: as many as voxels (CHECK).
Canvas tissue_sheet(const volume::Volume& volume, std::span<const volume::TissueClass> classes,
                    const volume::Organs& organs);

Colour colour_of(volume::TissueClass tissue);  // black: not tinted
Colour colour_of(volume::FoundOrgan organ);

}  // namespace seldinger::app
