// Under which conditions an attempt was made: what led the tools, what helped, what the workstation could do. Each
// is known or not: what is missing is never guessed, and attempts from before schema 13 have none at all.
#pragma once

#include <optional>
#include <string>

#include "assessment/plan_comparison.h"
#include "sim/base/names.h"
#include "sim/case/hand_kind.h"
#include "sim/case/record/recording.h"

namespace seldinger::casedb {

enum class Handedness { left, right };  // the hand that holds the needle
inline constexpr auto kHandednessNames =
    base::names<Handedness>({{Handedness::left, "left"}, {Handedness::right, "right"}});

// Of lengths of time, in ms.
struct LagQuantiles {
  std::optional<double> p50_ms, p95_ms, most_ms;
};

// In the patient's LPS; all of it, or nothing.
struct LpsPlace {
  std::optional<double> x_mm, y_mm, z_mm;
};

// What each means, and in which unit, is told by its row in condition_table.h.
struct Conditions {
  std::optional<cases::HandKind> needle_hand, probe_hand;
  std::optional<int> hand_changes;
  std::optional<std::string> needle_arm, probe_arm;
  std::optional<Handedness> handedness;
  std::optional<bool> guide_used;
  std::optional<double> guide_share;
  std::optional<int> help_level;
  std::optional<int> pauses;
  std::optional<double> paused_s;
  std::optional<bool> begun_again;
  std::optional<int> expert_replays, own_replays;
  LpsPlace planned_entry, planned_tip;
  std::optional<std::string> picture_method;
  std::optional<bool> speckle_fallback;
  std::optional<double> picture_rate_hz, window_rate_hz;
  LagQuantiles force_lag, room_lag, picture_lag;
  std::optional<bool> sound, stereo;
  std::optional<int> window_width_px, window_height_px;
  std::optional<std::string> station;
};

// The way that the trainee planned before the room. Nothing: none was, or it is not known.
std::optional<assessment::PlannedPath> planned_path(const Conditions& conditions);
void put_planned_path(const std::optional<assessment::PlannedPath>& path, Conditions& conditions);

// What of them follows from the recording itself is put in: of one whose recorder noted what led the tools
// (cases::EventInfo::noted). Of others nothing is.
void add_recorded(const cases::Recording& recording, Conditions& conditions);

// All that is known of an attempt that a simulated operator made.
Conditions simulated_conditions();

// What `newer` knows replaces what `older` does.
Conditions joined(const Conditions& older, const Conditions& newer);

}  // namespace seldinger::casedb
