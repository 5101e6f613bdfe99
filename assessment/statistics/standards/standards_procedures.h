// The rows of `seldinger stats` about standards: where a cut comes from, and how far its decisions can be relied
// on.
#pragma once

#include <span>

#include "assessment/statistics/procedure.h"

namespace seldinger::assessment::statistics {

std::span<const Procedure> standards_procedures();

}  // namespace seldinger::assessment::statistics
