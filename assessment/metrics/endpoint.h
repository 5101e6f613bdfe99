// Metrics of the moment the trigger fell.
#pragma once

#include "assessment/metrics/metric.h"

namespace seldinger::assessment {

Measured hit(const Signals& signals);
Measured core_in_target(const Signals& signals);
Measured tip_target_dist(const Signals& signals);
Measured tip_target_surface(const Signals& signals);
Measured tip_target_axial(const Signals& signals);
Measured tip_target_lateral(const Signals& signals);

}  // namespace seldinger::assessment
