// Metrics of time and of the recording's quality.
#pragma once

#include "assessment/metrics/metric.h"

namespace seldinger::assessment {

Measured time_total(const Signals& signals);
Measured gap_share(const Signals& signals);

}  // namespace seldinger::assessment
