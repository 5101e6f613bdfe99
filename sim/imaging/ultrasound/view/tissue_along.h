// The tissue along a beam at many depths, by the bits of one at a time (BeamPath::at, then TissueAt): plain loops
// over places side by side, which compilers run several at a time (CMakeLists.txt).
#pragma once

#include <span>

#include "sim/imaging/ultrasound/view/fan.h"
#include "sim/imaging/ultrasound/view/motion.h"

namespace seldinger::imaging {

// As many as there is room for (CHECKed).
void tissue_along(const BeamPath& path, const TissueAt& tissue_at, std::span<const double> depths_mm,
                  std::span<volume::TissueClass> tissue);

}  // namespace seldinger::imaging
