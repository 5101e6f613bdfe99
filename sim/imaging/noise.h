// Quantum noise: Poisson counts as a pure function of (seed, frame, pixel). The same bits on every machine, in any
// order and for any number of threads.
#pragma once

#include <cstdint>

#include "shaders/shared/noise.glsl.h"

namespace seldinger::imaging {

struct NoiseKey {
  std::uint32_t first = 0, second = 0;
};
NoiseKey noise_key(std::uint64_t seed, std::uint64_t frame) noexcept;

// 32 bits of pixel `pixel`.
inline std::uint32_t noise_bits(NoiseKey key, std::uint32_t pixel) noexcept {
  return shaders::noise_bits_of(key.first, key.second, pixel);
}

// Below this mean, counts are drawn by inversion of the distribution function; above, by Cornish and Fisher's
// expansion of its quantile (Abramowitz and Stegun 26.2.49) with a correction for whole numbers.
constexpr float kInversionMean = 16.0F;

// counts[i] for pixel first_pixel + i of expected `means[i]` ≥ 0; NaN stays NaN. With `electronic_quanta` > 0,
// normal noise of that standard deviation is added and counts are not whole (and may be negative).
void noisy_counts(const float* means, int count, NoiseKey key, std::uint32_t first_pixel, float electronic_quanta,
                  float* counts) noexcept;

}  // namespace seldinger::imaging
