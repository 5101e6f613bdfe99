// The picture that guides, as whoever made the attempt saw it: under a probe at the picture's rate, held while it
// is frozen; a fluoroscope's last image between its pulses.
#pragma once

#include <cstdint>
#include <memory>

#include "session/guidance/grey_picture.h"
#include "session/guidance/guidance.h"
#include "sim/case/case.h"
#include "sim/case/state.h"
#include "sim/tissue/displacement.h"

namespace seldinger::session {

class GuidanceScreen {
 public:
  // `scene` (with its tissue under ultrasound) must outlive it. `seed` is the noise's.
  GuidanceScreen(const cases::Case& scene, std::uint64_t seed);

  // After each tick, in order. Draws nothing.
  void tick(const cases::State& state, const tissue::Displacement& displacement);

  // What is on the screen now, drawn when it is asked for; without pixels before the first picture.
  const GreyPicture& picture();
  bool live() const noexcept { return live_; }  // neither frozen nor held

 private:
  std::unique_ptr<Guidance> guidance_;
  std::uint64_t seed_;
  cases::State shown_;  // of which the screen shows the picture
  tissue::Displacement shown_displacement_{};
  bool live_ = false, drawn_ = true;
  GreyPicture picture_;
};

}  // namespace seldinger::session
