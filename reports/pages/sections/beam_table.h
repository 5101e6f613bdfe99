// Where a fluoroscope looked from and when: the recording's pulses, gathered into looks.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "reports/markup/html.h"
#include "sim/case/record/recording.h"

namespace seldinger::reports {

// Pulses that follow each other from one direction, all at rest or all with the arm moving.
struct Look {
  double from_s = 0.0, beam_s = 0.0;
  int pulses = 0;
  cases::BeamTruth last;  // its last pulse
  bool hand_in_beam = false;
};

// Directions within a degree are one: an arm comes to rest in steps.
std::vector<Look> looks_of(std::span<const cases::FrameTruth> frames);

// "RAO 12°, caudal 5°"; 0° says AP.
std::string direction_text(const cases::BeamTruth& beam);

// Of the last image at or before t_s: direction, kV, mA; nothing before the first pulse.
std::optional<std::string> image_text(std::span<const cases::FrameTruth> frames, double t_s);

// Empty when no pulse was fired.
Html beam_table(const cases::Recording& recording);

}  // namespace seldinger::reports
