// Metrics of an attempt guided by fluoroscopy: what was spent, and how the machine was used.
#pragma once

#include "assessment/metrics/metric.h"

namespace seldinger::assessment {

Measured pulses(const Signals& signals);
Measured pulse_rate_max(const Signals& signals);
Measured fluoroscopy_time(const Signals& signals);
Measured dap(const Signals& signals);
Measured air_kerma(const Signals& signals);
Measured beam_while_moving(const Signals& signals);
Measured collimated_share(const Signals& signals);
Measured views(const Signals& signals);
Measured view_angle_max(const Signals& signals);
Measured hand_in_beam(const Signals& signals);
Measured longest_advance_between_exposures(const Signals& signals);

}  // namespace seldinger::assessment
