// Turns the loop of one simulated attempt: operator → virtual device → step → pictures → operator, and records it.
// By the case's modality the picture is a slice or ultrasound under the probe, or the fluoroscope's.
#pragma once

#include <cstdint>
#include <functional>
#include <span>

#include "assessment/operators/plan.h"
#include "assessment/operators/profile.h"
#include "sim/case/case.h"
#include "sim/case/recording.h"
#include "sim/case/state.h"
#include "sim/tissue/displacement.h"

namespace seldinger::app {

constexpr double kMaxAttemptSeconds = 300.0;  // an operator who has not fired by then gives up

// `scenario`: a mentor's events, by rising time.
cases::Recording run_attempt(const cases::Case& scene, const assessment::PuncturePlan& plan,
                             const assessment::OperatorProfile& profile, std::uint64_t seed,
                             std::span<const cases::Event> scenario = {});

// What the picture under the probe shows of a state and how its tissue is displaced, of slice or ultrasound
// (CHECKed); the scene must outlive it.
using Sight = std::function<cases::FrameTruth(const cases::State&, const tissue::Displacement&)>;
Sight sight_of(const cases::Case& scene);

// The picture when the trigger fell (or last), as PNG: slice or ultrasound under the probe, or the fluoroscope's
// last image. Empty where there is none.
std::vector<std::byte> picture_at_endpoint(const cases::Case& scene, const cases::Recording& recording);

// Replays the inputs by this step version: states, poses and, where the scene has tissue and the recording them,
// forces. `seen` is called after each tick, up to the first that differs. What another step version recorded is
// walked through and compared with nothing: not the same.
using TickSeen = std::function<void(const cases::State&, const tissue::Displacement&)>;
struct Replay {
  bool same = false;
  std::uint64_t first_difference_tick = 0;
};
Replay replay(const cases::Case& scene, const cases::Recording& recording, const TickSeen& seen = {});

}  // namespace seldinger::app
