// An angle brought into a quarter turn about zero, for exact_sin and its like.
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>

namespace seldinger::base {

struct Reduced {
  double r = 0.0;
  int quadrant = 0;
};

// π/2 in three parts of decreasing size (Cody and Waite 1980): n·kHigh is exact for |n| < 2^20.
inline Reduced reduce(double x_rad) noexcept {
  constexpr double kHigh = 0x1.921fb54400000p+0, kMiddle = 0x1.0b4611a600000p-34, kLow = 0x1.3198a2e037073p-69;
  const double n = std::floor(x_rad / (std::numbers::pi / 2) + 0.5);
  const double r = ((x_rad - n * kHigh) - n * kMiddle) - n * kLow;
  return {r, static_cast<int>(static_cast<std::int64_t>(n) & 3)};
}

}  // namespace seldinger::base
