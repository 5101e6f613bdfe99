// The rows of `seldinger stats` about reliability and agreement.
#pragma once

#include <span>

#include "assessment/statistics/procedure.h"

namespace seldinger::assessment::statistics {

std::span<const Procedure> reliability_procedures();

}  // namespace seldinger::assessment::statistics
