// The shelf's table: one and two samples, several groups, many tests, planning.
#pragma once

#include <span>

#include "assessment/statistics/procedure.h"

namespace seldinger::assessment::statistics {

std::span<const Procedure> groups_procedures();

}  // namespace seldinger::assessment::statistics
