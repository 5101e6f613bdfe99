#include "sim/base/exact_math.h"

#include <bit>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "sim/base/exact_reduction.h"

namespace seldinger::base {
namespace {

constexpr double kPi = std::numbers::pi;

// Taylor series on |r| ≤ π/4: the first term left out is below 1e-17.
double sin_near_zero(double r) noexcept {
  const double z = r * r;
  double sum = 0.0;
  for (int k = 17; k >= 3; k -= 2) sum = (1.0 - sum) * z / (k * (k - 1.0));
  return r * (1.0 - sum);
}

double cos_near_zero(double r) noexcept {
  const double z = r * r;
  double sum = 0.0;
  for (int k = 18; k >= 2; k -= 2) sum = (1.0 - sum) * z / (k * (k - 1.0));
  return 1.0 - sum;
}

}  // namespace

double exact_sin(double x_rad) noexcept {
  const Reduced a = reduce(x_rad);
  const double value = (a.quadrant & 1) != 0 ? cos_near_zero(a.r) : sin_near_zero(a.r);
  return a.quadrant >= 2 ? -value : value;
}

double exact_cos(double x_rad) noexcept {
  const Reduced a = reduce(x_rad);
  const double value = (a.quadrant & 1) != 0 ? sin_near_zero(a.r) : cos_near_zero(a.r);
  return a.quadrant == 1 || a.quadrant == 2 ? -value : value;
}

double exact_exp(double x) noexcept {
  // Clamped so that the result stays a normal number.
  x = x < -700.0 ? -700.0 : (x > 700.0 ? 700.0 : x);
  constexpr double kLn2High = 0x1.62e42fee00000p-1;
  constexpr double kLn2Low = 0x1.a39ef35793c76p-33;
  const double n = std::floor(x / 0x1.62e42fefa39efp-1 + 0.5);
  const double r = (x - n * kLn2High) - n * kLn2Low;  // |r| ≤ 0.347
  double sum = 1.0;
  for (int k = 14; k >= 1; --k) sum = 1.0 + sum * r / k;
  const auto exponent = static_cast<std::uint64_t>(1023 + static_cast<std::int64_t>(n));
  return sum * std::bit_cast<double>(exponent << 52);
}

double exact_log(double x) noexcept {
  const auto bits = std::bit_cast<std::uint64_t>(x);
  auto exponent = static_cast<double>(static_cast<std::int64_t>((bits >> 52) & 0x7ff) - 1023);
  double mantissa = std::bit_cast<double>((bits & 0x000fffffffffffffULL) | 0x3ff0000000000000ULL);
  if (mantissa > 0x1.6a09e667f3bcdp+0) {
    mantissa *= 0.5;
    exponent += 1.0;
  }
  const double t = (mantissa - 1.0) / (mantissa + 1.0);  // |t| ≤ 0.172; log m = 2 artanh t
  const double z = t * t;
  double sum = 0.0;
  for (int k = 21; k >= 1; k -= 2) sum = sum * z + 1.0 / k;
  return exponent * 0x1.62e42fefa39efp-1 + 2.0 * t * sum;
}

double exact_atan(double x) noexcept {
  if (x < 0.0) return -exact_atan(-x);
  if (x > 1.0) return kPi / 2 - exact_atan(1.0 / x);
  // atan x = 2 atan(x / (1 + √(1 + x²))), twice: the series then runs on |t| ≤ 0.199.
  double t = x / (1.0 + std::sqrt(1.0 + x * x));
  t = t / (1.0 + std::sqrt(1.0 + t * t));
  const double z = t * t;
  double sum = 0.0;
  for (int k = 25; k >= 1; k -= 2) sum = 1.0 / k - sum * z;
  return 4.0 * t * sum;
}

double exact_acos(double x) noexcept {
  x = x < -1.0 ? -1.0 : (x > 1.0 ? 1.0 : x);
  if (x == -1.0) return kPi;
  return 2.0 * exact_atan(std::sqrt((1.0 - x) / (1.0 + x)));
}

}  // namespace seldinger::base
