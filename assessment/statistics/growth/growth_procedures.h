// The shelf's table: how skill grows, when it suffices, whether it lasts; ability and difficulty on one scale.
#pragma once

#include <span>

#include "assessment/statistics/procedure.h"

namespace seldinger::assessment::statistics {

std::span<const Procedure> growth_procedures();

}  // namespace seldinger::assessment::statistics
