// Attempts drawn by chance, one for each seed: settings of every manner and hands that approach, puncture, push,
// jiggle, withdraw, turn, wait, move the probe, fire or give up. Cheap: no case is loaded and nothing is simulated.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "assessment/signals/signals.h"
#include "tests/assessment/laws/random_hands.h"

namespace seldinger::assessment {

struct RandomAttempt {
  std::uint64_t seed = 0;
  double pose_hz = 100.0;
  AttemptSetting setting;  // without what it points to
  std::shared_ptr<const cases::Mesh> mesh;
  std::shared_ptr<const cases::MeshIndex> skin;
  std::vector<cases::Structure> structures;
  cases::Recording recording;

  base::Result<Signals> signals() const;
  std::string words() const;  // "seed 17: ultrasound in plane, access needle, breathing"
};

// As `breathes` of its setting says, the tissue moves and the hands go with it.
RandomAttempt random_attempt(std::uint64_t seed);

// At the same desk, nobody does anything: needle and probe lie outside, nothing is said.
RandomAttempt nothing_done(std::uint64_t seed);

// Without breath, as `random_attempt` begins it.
RandomAttempt random_attempt_at_rest(std::uint64_t seed);

// Hands as they were relative to the tissue, which moves by `amplitude_mm`; held breath stands still.
void ride_on_breath(RandomAttempt& attempt, double amplitude_mm);

// The same hands in the room over tissue that slides along under them, more the deeper it lies; skin lies still.
void slide_under_hands(RandomAttempt& attempt, double amplitude_mm);

}  // namespace seldinger::assessment
