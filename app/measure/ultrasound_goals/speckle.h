// Statistics of speckle at one depth, beside what the goals ask of them.
#pragma once

#include "app/measure/ultrasound_goals/goal.h"

namespace seldinger::measure {

struct SpeckleStatistics {
  double depth_mm;
  double snr, ks, nakagami_m, mean_square;  // of the envelope; ks: to Rayleigh's distribution
  double cells;                             // independent values behind them
};
constexpr double kRayleighSnr = 1.9130;  // √(π/(4 − π))
constexpr double kLeastCells = 7000.0;

// Of liver without loss at 10, 30 … 90 % of the depth, from as many frames as give kLeastCells at each.
std::vector<SpeckleStatistics> speckle_statistics(const Setting& setting);
// Goal 6 of them.
void read_statistics(const Setting& setting, std::span<const SpeckleStatistics> at_depths, Readings& readings);

// FWHM of the intensity's correlation over that of the beam, at one share of the depth. Not finite or 0 where
// there is no such width.
struct WidthRatios {
  double axial, lateral, elevation;
};
WidthRatios speckle_widths(const Setting& setting, double share_of_depth);

}  // namespace seldinger::measure
