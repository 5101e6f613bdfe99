// Force-feedback devices and the hands on them, along one axis, as numbers. They stand in for hardware on the rig
// (hand_rig.h), and a device's row gives the needle law its stiffness.
#pragma once

#include <span>

#include "sim/base/tick.h"
#include "sim/haptics/needle/needle_law.h"

namespace seldinger::haptics {

using base::kTickS;  // of every law here

struct ArmModel {
  const char* name;
  double mass_kg;         // what the hand feels of it
  double damping_n_s_mm;  // viscous
  double coulomb_n;       // dry friction, static and sliding alike
  double encoder_mm;      // one count at the tip; 0: continuous
  double peak_n;          // the motors' most
  double continuous_n;    // what they bear for ever
  int delay_ticks;        // from encoder to motor, 0 to kMostDelayTicks
  const char* provenance;
};

inline constexpr int kMostDelayTicks = 3;

struct Hand {
  const char* name;
  double mass_kg, damping_n_s_mm, stiffness_n_mm;  // holds the device to a point of its own; all 0: let go
  const char* provenance;
};

std::span<const ArmModel> arm_models();
std::span<const Hand> hands();

// nullptr for a name that is not in the table.
const ArmModel* find_arm_model(const char* name);
const Hand* find_hand(const char* name);

// However short the delay: at 200 mm/s a wall of 0.5 N/mm and its damper change by 0.15 N a tick, the most
// that a tick may step (docs/touch.md).
inline constexpr double kMostStiffnessNMm = 0.5;

// For the device, with its delay: bound / kStiffnessMargin, at most kMostStiffnessNMm.
double stiffness_n_mm(const ArmModel& device);
NeedleSettings needle_settings(const ArmModel& device);

}  // namespace seldinger::haptics
