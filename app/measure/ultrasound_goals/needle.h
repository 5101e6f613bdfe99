// The needle in water, as the goals look at it.
#pragma once

#include "app/measure/ultrasound_goals/goal.h"

namespace seldinger::measure {

// In the plane, tip at (x, depth), rising towards the first beam at `tilt_deg` to the face; `out_mm` off the plane.
imaging::Inserted needle_at(double x_mm, double depth_mm, double tilt_deg, double out_mm = 0.0);

// Grey of the shaft, as a share of white, seen `tilt_deg` off its normal at 25 mm, without loss on the way.
double needle_grey(const Setting& setting, double tilt_deg, bool echogenic);

}  // namespace seldinger::measure
