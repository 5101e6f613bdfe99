// The picture that guides, as whoever made the attempt saw it: under a probe at the picture's rate, held while it
// is frozen; a fluoroscope's last image between its pulses.
#pragma once

#include <cstdint>
#include <optional>

#include "app/fluoroscopy.h"
#include "app/grey_picture.h"
#include "app/picture_clock.h"
#include "app/ultrasound_sight.h"
#include "sim/case/case.h"
#include "sim/case/state.h"
#include "sim/tissue/displacement.h"

namespace seldinger::app {

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
  const cases::Case& scene_;
  std::uint64_t seed_;
  std::optional<UltrasoundSight> sight_;
  std::optional<FluoroscopyRoom> room_;
  cases::State shown_;  // of which the screen shows the picture
  tissue::Displacement shown_displacement_{};
  PictureClock clock_;
  bool live_ = false, drawn_ = true;
  GreyPicture picture_;
};

}  // namespace seldinger::app
