// What moves a scene's tissue now: breath, probe and needle, as one displacement (sim/tissue/displacement.h). A
// scene that asks for none of it has no source, and everything here is free.
#pragma once

#include <optional>
#include <vector>

#include "sim/case/case.h"
#include "sim/case/state.h"
#include "sim/haptics/two_hands.h"
#include "sim/tissue/cavity_wall.h"
#include "sim/tissue/displacement.h"
#include "sim/tissue/loose_organs.h"
#include "sim/tissue/veins.h"

namespace seldinger::engine {

class MovingTissue {
 public:
  // The scene must outlive it. One pass over its classes where it breathes, and where organs give way.
  explicit MovingTissue(const cases::Case& scene);

  // Whether anything can move at all.
  bool moves() const noexcept { return region_.has_value() || scene_.yields; }
  bool breathes() const noexcept { return region_.has_value(); }
  // Those that give way to a probe; none where tissue does not yield.
  const std::vector<tissue::CompressibleVein>& veins() const noexcept { return veins_; }
  // Those that give way to a needle; none by a law of touch of before.
  const std::vector<tissue::LooseOrgan>& organs() const noexcept { return organs_; }

  // What a hand finds: displaced by breath and by what the other hand holds. Hands by Side; of what is in hand.
  tissue::Displacement felt_by_needle(const cases::State& state, const haptics::HandStates& hands) const noexcept;
  tissue::Displacement felt_by_probe(const cases::State& state) const noexcept;
  // What every picture shows and metrics count: the needle's own drag, too.
  tissue::Displacement seen(const cases::State& state, const haptics::HandStates& hands) const noexcept;

 private:
  tissue::Displacement of(const cases::State& state, const haptics::HandStates* presses,
                          const haptics::HandStates* drags) const noexcept;

  const cases::Case& scene_;
  std::optional<tissue::BreathRegion> region_;  // where it breathes
  std::optional<tissue::CavityWall> wall_;      // under which organs slide
  std::vector<tissue::CompressibleVein> veins_;
  std::vector<tissue::LooseOrgan> organs_;  // by the newest law of touch
};

// A tool's pose as it is to the tissue at rest: its tip there, and a point `behind_mm` up the shaft, too.
cases::ToolPose at_rest(const tissue::Displacement& displacement, const cases::ToolPose& pose,
                        double behind_mm) noexcept;

}  // namespace seldinger::engine
