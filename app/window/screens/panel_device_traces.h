// Two arms, live: where each is and what force it was asked for, over the last seconds.
#pragma once

#include "app/hands/arms_seen.h"

namespace seldinger::app {

// In the width there is, both hands beside each other; of so many pixels in height.
void draw_arm_traces(const ArmsSeen& arms, float height_px);

}  // namespace seldinger::app
