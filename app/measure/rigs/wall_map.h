// Which walls a device can show: the plain wall struck at 100 mm/s and pushed on by 1 N, over stiffness, damping
// and delay, beside the bound that theory gives.
#pragma once

#include <vector>

#include "sim/haptics/arm_model.h"

namespace seldinger::measure {

struct WallCell {
  double stiffness_n_mm, damping_n_s_mm;
  int delay_ticks;
  double bound_n_mm;  // K ≤ (b + B) / (T/2 + td)
  bool settles;
};

inline constexpr double kMapStiffnessNMm[] = {0.1, 0.15, 0.22, 0.33, 0.47, 0.68, 1.0,
                                              1.5, 2.2,  3.3,  4.7,  6.8,  10.0};
inline constexpr double kMapDampingNSMm[] = {0.0, 0.0005, 0.001, 0.002, 0.003};

// By delay (0 to kMostDelayTicks in the device's stead), then damping, then stiffness.
std::vector<WallCell> wall_map(const haptics::ArmModel& device, const haptics::Hand& hand);

}  // namespace seldinger::measure
