// The situations in which a needle's law must come to rest, and the laws that are put into them: ours and the
// thesis'. `seldinger haptics stability` and the tests ask the same.
#pragma once

#include <span>
#include <vector>

#include "app/measure/rigs/settling.h"

namespace seldinger::measure {

struct NeedleSituation {
  const char* name;
  std::vector<haptics::NeedleLayer> path;
  double to_mm, back_mm = 0.0, speed_mm_s = 0.0;  // as a Trial's
};

const std::vector<NeedleSituation>& needle_situations();

// Our law, `factor` times as stiff as it is for the device.
Settling settle_needle(const NeedleSituation& situation, const haptics::ArmModel& device, const haptics::Hand& hand,
                       double factor = 1.0);

// A hand drives the needle on in the kidney at the thesis' 500 mm/min. By our law; by the thesis' with the mean of
// m ticks.
Settling drive_needle(const haptics::ArmModel& device, const haptics::Hand& hand);
Settling drive_thesis(const haptics::ArmModel& device, const haptics::Hand& hand, int m);

}  // namespace seldinger::measure
