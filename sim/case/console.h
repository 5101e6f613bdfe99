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
}

}  // namespace seldinger::cases
