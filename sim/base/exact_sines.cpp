#include "sim/base/exact_sines.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "sim/base/check.h"
#include "sim/base/exact_reduction.h"

namespace seldinger::base {
namespace {

constexpr std::size_t kLanes = 8;
using Lanes = std::array<double, kLanes>;

// As sin_near_zero and cos_near_zero in one: cosine's series has one term more, and other divisors. Loops over
// lanes are what a compiler makes vectors of.
void sines_of(const Lanes& x_rad, Lanes& sines) noexcept {
  Lanes r{}, z{}, sum{}, cosine{};
  std::array<int, kLanes> quadrant{};
  for (std::size_t i = 0; i < kLanes; ++i) {
    const Reduced a = reduce(x_rad[i]);
    r[i] = a.r;
    quadrant[i] = a.quadrant;
    cosine[i] = static_cast<double>(a.quadrant & 1);
  }
  for (std::size_t i = 0; i < kLanes; ++i) {
    z[i] = r[i] * r[i];
    sum[i] = cosine[i] * (z[i] / (18.0 * 17.0));
  }
  for (int k = 17; k >= 3; k -= 2) {
    const double of_sine = k * (k - 1.0), less = (k - 1.0) * (k - 2.0) - of_sine;
    for (std::size_t i = 0; i < kLanes; ++i) sum[i] = (1.0 - sum[i]) * z[i] / (of_sine + cosine[i] * less);
  }
  for (std::size_t i = 0; i < kLanes; ++i) {
    const double value = (quadrant[i] & 1) != 0 ? 1.0 - sum[i] : r[i] * (1.0 - sum[i]);
    sines[i] = quadrant[i] >= 2 ? -value : value;
  }
}

}  // namespace

void exact_sines(std::span<const double> x_rad, std::span<double> sines) noexcept {
  CHECK(x_rad.size() == sines.size());
  for (std::size_t at = 0; at < x_rad.size(); at += kLanes) {
    const std::size_t count = std::min(kLanes, x_rad.size() - at);
    Lanes x{}, made;
    std::copy_n(x_rad.data() + at, count, x.data());
    sines_of(x, made);
    std::copy_n(made.data(), count, sines.data() + at);
  }
}

}  // namespace seldinger::base
