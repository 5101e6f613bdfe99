// Skin punctures and withdrawals.
#pragma once

#include "assessment/metrics/metric.h"

namespace seldinger::assessment {

Measured skin_punctures(const Signals& signals);
Measured withdrawals_partial(const Signals& signals);
Measured withdrawals_full(const Signals& signals);

}  // namespace seldinger::assessment
