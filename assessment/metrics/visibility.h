// Shares of time, and of the way, in which the picture showed needle tip, target, or both.
#pragma once

#include "assessment/metrics/metric.h"

namespace seldinger::assessment {

Measured vis_needle(const Signals& signals);
Measured vis_target(const Signals& signals);
Measured vis_joint(const Signals& signals);
Measured vis_joint_2_mm(const Signals& signals);
Measured vis_joint_5_mm(const Signals& signals);
Measured visible_needle_length(const Signals& signals);
Measured advance_visible_share(const Signals& signals);

}  // namespace seldinger::assessment
