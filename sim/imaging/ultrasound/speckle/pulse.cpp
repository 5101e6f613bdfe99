#include "sim/imaging/ultrasound/speckle/pulse.h"

#include <algorithm>
#include <cmath>

namespace seldinger::imaging {
namespace {

constexpr double kLeastShare = 0.01;  // of the wanted variance

}  // namespace

std::vector<PulseTap> pulse_taps(double sigma_mm, double sample_mm, int fine) {
  const double fine_mm = sample_mm / fine;
  // A sample itself is as long as a pulse of fine²/12; where that is longer than the wanted one, it is all there
  // is.
  const double variance =
      std::max(sigma_mm * sigma_mm - fine_mm * fine_mm / 12.0, kLeastShare * sigma_mm * sigma_mm);
  const int reach = static_cast<int>(std::ceil(3.5 * sigma_mm / sample_mm)) + 1;
  std::vector<PulseTap> taps;
  double energy = 0.0;
  for (int shift = -reach; shift <= reach; ++shift)
    for (int part = 0; part < fine; ++part) {
      const double off_mm = (shift * fine + part + 0.5 - 0.5 * fine) * fine_mm;
      if (std::abs(off_mm) > 3.5 * sigma_mm) continue;
      const double h = std::exp(-0.5 * off_mm * off_mm / variance);
      energy += h * h * fine_mm;
      taps.push_back({part, shift, static_cast<float>(h)});
    }
  for (PulseTap& tap : taps) tap.weight /= static_cast<float>(std::sqrt(energy));
  return taps;
}

}  // namespace seldinger::imaging
