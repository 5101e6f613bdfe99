// exp, log (NaN stays NaN) and the normal quantile in float, of + − × ÷ √ and integer bits only: the same bits on
// every machine, and plain enough for the compiler to run four or more at a time.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>

namespace seldinger::imaging {

// Relative error < 2e-7 for −87 ≤ x ≤ 87; clamped outside. Polynomial of Moshier's Cephes (expf).
inline float float_exp(float x) noexcept {
  constexpr float kShift = 12582912.0F;  // 1.5·2²³: adding it rounds to a whole number
  const float clamped = x > -87.0F ? (x < 87.0F ? x : 87.0F) : -87.0F;  // and NaN, answered below
  const float whole = (clamped * 1.44269504F + kShift) - kShift;
  const float r = (clamped - whole * 0.693359375F) + whole * 2.12194440e-4F;
  float p = 1.9875691500e-4F;
  p = p * r + 1.3981999507e-3F;
  p = p * r + 8.3334519073e-3F;
  p = p * r + 4.1665795894e-2F;
  p = p * r + 1.6666665459e-1F;
  p = p * r + 5.0000001201e-1F;
  p = p * (r * r) + r + 1.0F;
  const std::int32_t exponent = (static_cast<std::int32_t>(whole) + 127) << 23;
  return x == x ? p * std::bit_cast<float>(exponent) : x;
}

// x > 0 and normal. Absolute error < 2e-7·max(1, |log x|). Polynomial of Cephes (logf).
inline float float_log(float x) noexcept {
  // mantissa in [√½, √2)
  const std::int32_t bits = std::bit_cast<std::int32_t>(x);
  const std::int32_t exponent = (bits - 0x3f3504f3) >> 23;
  const float m = std::bit_cast<float>(bits - (exponent << 23)) - 1.0F;
  const float e = static_cast<float>(exponent);
  float p = 7.0376836292e-2F;
  p = p * m - 1.1514610310e-1F;
  p = p * m + 1.1676998740e-1F;
  p = p * m - 1.2420140846e-1F;
  p = p * m + 1.4249322787e-1F;
  p = p * m - 1.6668057665e-1F;
  p = p * m + 2.0000714765e-1F;
  p = p * m - 2.4999993993e-1F;
  p = p * m + 3.3333331174e-1F;
  const float z = m * m;
  const float log = (m + (p * m * z - 2.12194440e-4F * e - 0.5F * z)) + 0.693359375F * e;
  return x == x ? log : x;
}

// Giles, "Approximating the erfinv function", GPU Computing Gems 2 (2011) 109: relative error < 4e-7. x = 2u − 1 in
// (−1, 1); answers the standard normal that has the share u below it. The middle holds for kQuantileMiddle ≥ |x|.
constexpr float kQuantileMiddle = 0.9966F;
inline float normal_quantile_middle(float x) noexcept {
  const float w = -float_log((1.0F - x) * (1.0F + x)) - 2.5F;
  float p = 2.81022636e-8F;
  p = p * w + 3.43273939e-7F;
  p = p * w - 3.5233877e-6F;
  p = p * w - 4.39150654e-6F;
  p = p * w + 2.1858087e-4F;
  p = p * w - 1.25372503e-3F;
  p = p * w - 4.17768164e-3F;
  p = p * w + 2.46640727e-1F;
  p = p * w + 1.50140941F;
  return 1.41421356F * (p * x);
}
inline float normal_quantile_tail(float x) noexcept {
  const float w = std::sqrt(-float_log((1.0F - x) * (1.0F + x))) - 3.0F;
  float p = -2.00214257e-4F;
  p = p * w + 1.00950558e-4F;
  p = p * w + 1.34934322e-3F;
  p = p * w - 3.67342844e-3F;
  p = p * w + 5.73950773e-3F;
  p = p * w - 7.6224613e-3F;
  p = p * w + 9.43887047e-3F;
  p = p * w + 1.00167406F;
  p = p * w + 2.83297682F;
  return 1.41421356F * (p * x);
}

}  // namespace seldinger::imaging
