// Everything that the rig says about stability, as `seldinger haptics stability` answers it: our laws under every
// hand, both laws driven by hands, and maps of the plain wall.
#pragma once

#include <vector>

#include "app/measure/rigs/needle_trials.h"
#include "app/measure/rigs/wall_map.h"

namespace seldinger::measure {

// Dry friction of next to none: the worst case of every device (our judgement).
inline constexpr double kLeastCoulombN = 0.02;

struct RestRow {
  haptics::ArmModel device;
  haptics::Hand hand;
  const char* situation;
  Settling settling;
  // At rest, no energy given, no step of the force above 0.15 N (docs/touch.md).
  bool holds() const noexcept;
};

// By how much our stiffness may be multiplied until needle or probe, let go, rests no more in some situation.
struct MarginRow {
  haptics::ArmModel device;
  double rests_at;    // the largest of kMarginFactors up to which it rests in all; 0: not even as it is
  const char* fails;  // where it does not any more; nullptr: it rests at all factors
};
inline constexpr double kMarginFactors[] = {1.0, 1.2, 1.4, 1.7, 2.0, 2.4, 3.0, 4.0};

struct DrivenRow {
  haptics::Hand hand;
  double ours_n;       // unrest of the motors' force
  double thesis_n[3];  // with the mean of kThesisMeans ticks
};
inline constexpr int kThesisMeans[] = {1, 10, 50};

struct WallMap {
  haptics::ArmModel device;
  haptics::Hand hand;
  std::vector<WallCell> cells;
};

// A wall of our damping that the margin allows but that does not come to rest.
bool breaks_the_rule(const WallCell& cell) noexcept;

struct StabilitySurvey {
  std::vector<RestRow> rest;
  std::vector<MarginRow> margins;  // with least friction, at every delay
  std::vector<DrivenRow> driven;   // on the first device of the table
  std::vector<WallMap> maps;

  bool holds() const noexcept;
};

// Every device as it is, and with least friction at every delay; takes seconds.
StabilitySurvey survey_stability();

}  // namespace seldinger::measure
