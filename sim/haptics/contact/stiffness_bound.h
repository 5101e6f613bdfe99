// How stiff a wall a sampled device can show without a limit cycle.
#pragma once

namespace seldinger::haptics {

// Margin kept to the bound by every preset.
inline constexpr double kStiffnessMargin = 1.4;

// The damping of our walls, N s/mm: 1 N s/m (our judgement; docs/stability.md tells what comes to rest with it).
inline constexpr double kWallDampingNSMm = 0.001;

// N/mm, for the device's and the wall's damping in N s/mm, the tick and the delay of the force in s:
// K ≤ (b + B) / (T/2 + td) (Colgate and Schenkel 1994; with delay Gil 2009, Hulin 2013).
constexpr double stiffness_bound_n_mm(double damping_n_s_mm, double tick_s, double delay_s) noexcept {
  return damping_n_s_mm / (tick_s / 2.0 + delay_s);
}

}  // namespace seldinger::haptics
