// How the machine under the probe is set, as far as that changes what its picture can show. What acts on the screen
// alone (gain, windows, maps) is no part of an attempt.
#pragma once

#include <cmath>

namespace seldinger::cases {

// What a number asks beyond what the machine can do, is brought to what it can by whoever makes the picture.
struct ConsoleSetting {
  double depth_mm = 0.0, focus_mm = 0.0, frequency_mhz = 0.0;  // of ultrasound; 0: as the case's picture has it
  double slice_mm = 0.0;     // of slices: so far beside the probe's plane, along axial × lateral
  double colour_mm_s = 0.0;  // of ultrasound: colour Doppler, by the speed at which it wraps around; 0: off
  // Spatial compounding: with the picture those are averaged that look so far from either side; 0: off.
  double compound_deg = 0.0;
  double lean_deg = 0.0;  // of colour's beams from a straight face, > 0 towards the last one
  // Where the middle of colour's box is, as shares of the picture from its first beam and its face; 0: the box
  // takes nearly all of it.
  double box_across = 0.0, box_down = 0.0;
  bool operator==(const ConsoleSetting&) const = default;
};

// What is not finite leaves the last.
inline void turn(ConsoleSetting& console, const ConsoleSetting& asked) noexcept {
  const auto take = [](double wanted, double& is) {
    if (std::isfinite(wanted)) is = wanted;
  };
  take(asked.depth_mm, console.depth_mm);
  take(asked.focus_mm, console.focus_mm);
  take(asked.frequency_mhz, console.frequency_mhz);
  take(asked.slice_mm, console.slice_mm);
  take(asked.colour_mm_s, console.colour_mm_s);
  take(asked.compound_deg, console.compound_deg);
  take(asked.lean_deg, console.lean_deg);
  take(asked.box_across, console.box_across);
  take(asked.box_down, console.box_down);
}

}  // namespace seldinger::cases
