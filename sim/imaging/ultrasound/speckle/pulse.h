// The pulse on the complex baseband, as a filter from fine samples to samples.
#pragma once

#include <vector>

namespace seldinger::imaging {

struct PulseTap {
  int part, shift;  // fine sample (k + shift)·fine + part counts for sample k
  float weight;
};

// Scatterers lie in the fine sample that they fall in, which widens by a box of one: the kernel is narrower by that
// (variance fine²/12). ∫h² = 1. By rising shift, then part.
std::vector<PulseTap> pulse_taps(double sigma_mm, double sample_mm, int fine);

}  // namespace seldinger::imaging
