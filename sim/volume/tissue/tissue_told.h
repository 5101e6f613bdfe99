// What the classes of a CT are taken together, and what of them is doubtful: told when it is imported.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "sim/volume/tissue/contrast.h"

namespace seldinger::volume {

struct TissueTold {
  Contrast contrast;
  std::array<double, kTissueClasses> share{};  // by class, of the body: air has none
  std::vector<std::string> doubts;             // sentences without a full stop, for a person
};

// Classes: as many as voxels (CHECK); labelled: a label map told some of them; the aorta's level where it is known.
TissueTold tell_tissue(const Volume& volume, const std::vector<TissueClass>& classes, bool labelled,
                       std::optional<int> aorta_hu = {});

}  // namespace seldinger::volume
