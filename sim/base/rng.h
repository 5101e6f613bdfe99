// Counter-based random numbers: value i of stream `seed` is a pure function of (seed, i), in any order, on any
// machine.
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>

#include "sim/base/exact_math.h"
#include "sim/base/hash.h"

namespace seldinger::base {

// Uniform in [0, 1), 53 bits.
constexpr double uniform_at(std::uint64_t seed, std::uint64_t counter) noexcept {
  return static_cast<double>(hash_combine(seed, counter) >> 11) * 0x1.0p-53;
}

// Standard normal by Box and Muller (Ann. Math. Statist. 29, 1958), with our own log and cos.
inline double normal_at(std::uint64_t seed, std::uint64_t counter) noexcept {
  const double u = 1.0 - uniform_at(seed, 2 * counter);  // (0, 1]
  const double v = uniform_at(seed, 2 * counter + 1);
  return std::sqrt(-2.0 * exact_log(u)) * exact_cos(2.0 * std::numbers::pi * v);
}

// The same numbers drawn in order.
class Rng {
 public:
  explicit constexpr Rng(std::uint64_t seed) noexcept : seed_(mix64(seed)) {}
  double uniform() noexcept { return uniform_at(seed_, next_++); }
  double normal() noexcept { return normal_at(seed_ ^ 0x5bd1e995ULL, next_++); }
  std::uint64_t bits() noexcept { return hash_combine(seed_, next_++); }

 private:
  std::uint64_t seed_;
  std::uint64_t next_ = 0;
};

}  // namespace seldinger::base
