// The situations in which the probe's law must come to rest; beside needle_trials.h.
#pragma once

#include <span>

#include "app/measure/rigs/settling.h"

namespace seldinger::measure {

struct ProbeSituation {
  const char* name;
  double bone_mm;  // below the skin; infinity: none
  bool sideways;   // shifted along the skin, pressed in by 6 mm; else struck at 50 mm/s
};

std::span<const ProbeSituation> probe_situations();

// Our law, `factor` times as stiff as it is for the device, with `damping` times its damping.
Settling settle_probe(const ProbeSituation& situation, const haptics::ArmModel& device, const haptics::Hand& hand,
                      double factor = 1.0, double damping = 1.0);

}  // namespace seldinger::measure
