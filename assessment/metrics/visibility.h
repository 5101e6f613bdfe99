// Shares of time in which the picture showed needle tip, target, or both.
#pragma once

#include "assessment/metrics/metric.h"

namespace seldinger::assessment {

Measured vis_needle(const Signals& signals);
Measured vis_target(const Signals& signals);
Measured vis_joint(const Signals& signals);

}  // namespace seldinger::assessment
