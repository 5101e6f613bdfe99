// Where a probe stands for a planned way: beside the entry so that its plane holds the way, or across it.
#pragma once

#include <optional>

#include "assessment/operators/plan.h"

namespace seldinger::assessment {

// Completes a plan whose way is made: the best place on the skin from which the way and the target are seen. How
// good it is there, the more the better; nothing when there is none.
std::optional<double> place_probe(const cases::MeshIndex& skin, const PathLimits& limits, PuncturePlan& plan);

}  // namespace seldinger::assessment
