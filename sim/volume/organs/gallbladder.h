// The gallbladder: what is at water's level on the under side of a liver that is named. Inside sim/volume/organs
// only.
#pragma once

#include <optional>
#include <vector>

#include "sim/volume/organs/lattice.h"

namespace seldinger::volume {

// Candidates: even, compact pieces at water's level, with how parted they are as confidence. At most one of them,
// the surer the more of it lies on liver, the less on gas and kidney, and the less another looks like it. Kidneys:
// those that are named; what is brighter than the liver counts as one.
std::optional<Part> gallbladder_among(const OrganGrid& grid, std::vector<Part> candidates, const Part& liver,
                                      const std::vector<const Part*>& kidneys);

}  // namespace seldinger::volume
