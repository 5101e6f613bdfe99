// The shelf's table: proportions, relations, discrimination, counts, time to event, bootstrap.
#pragma once

#include <span>

#include "assessment/statistics/procedure.h"

namespace seldinger::assessment::statistics {

std::span<const Procedure> relations_procedures();

}  // namespace seldinger::assessment::statistics
