#include "assessment/operators/wander.h"

#include <numbers>

#include "sim/base/exact_math.h"

namespace seldinger::assessment {

double Wander::at(double t_s) const noexcept {
  double sum = 0.0;
  for (int i = 0; i < 3; ++i) sum += base::exact_sin(phase_rad[i] + rate_rad_s[i] * t_s);
  return sum / 1.224744871391589;  // √(3/2): unit variance
}

Wander make_wander(base::Rng& rng, double low_hz, double high_hz) {
  Wander wander;
  for (int i = 0; i < 3; ++i) {
    wander.phase_rad[i] = 2.0 * std::numbers::pi * rng.uniform();
    wander.rate_rad_s[i] = 2.0 * std::numbers::pi * (low_hz + (high_hz - low_hz) * rng.uniform());
  }
  return wander;
}

}  // namespace seldinger::assessment
