// Whether touch gives away energy when tissue moves under it (docs/touch.md, S15 and S18): hands at a scene that
// breathes or yields, and the work that goes each way. The tests assert what `seldinger goals haptics` prints.
#pragma once

#include <glm/vec3.hpp>
#include <vector>

#include "app/measure/rigs/force_reading.h"
#include "sim/case/case.h"

namespace seldinger::measure {

// Where a needle is put, and a probe pressed beside it.
struct TrialPlace {
  glm::dvec3 entry_lps_mm{0.0}, direction{0.0, 0.0, -1.0};  // unit, inwards
  double depth_mm = 45.0;
  glm::dvec3 probe_lps_mm{0.0}, probe_axis{0.0, 0.0, -1.0};  // on the skin; unit, inwards
};

// Each cycle's worst, after two for settling. Work in mJ.
struct EnergyTrial {
  double most_gain_mj = 0.0;  // what hands got beyond what breath put in (NaN: something was not finite)
  double tissue_mj = 0.0;     // the most that moving tissue had put in, or taken, within a cycle
  double drift_mm = 0.0;      // of the tip in tissue, from the third cycle's end to the last's
  double drift_n = 0.0;       // of the force, as that
  double line_mm = 0.0;       // by how much the line went that the skin holds
};

// A hand that holds the needle in who breathes, `cycles` breaths long: still, or as a spring (N/mm; 0: still).
EnergyTrial breathing_trial(const cases::Case& scene, const TrialPlace& place, double hand_n_mm, int cycles);
// Probe in and out beside a needle that a spring holds, in tissue that yields.
EnergyTrial coupled_trial(const cases::Case& scene, const TrialPlace& place, double hand_n_mm, int cycles);
// Probe in, along the skin, out and back, in the air.
EnergyTrial indentation_trial(const cases::Case& scene, const TrialPlace& place, int cycles);

// All of them, as goals. The scene's tissue is taken to breathe and to yield.
std::vector<ForceReading> motion_readings(cases::Case scene, const TrialPlace& place);

}  // namespace seldinger::measure
