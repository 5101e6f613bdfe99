#include "sim/imaging/noise.h"

#include <algorithm>
#include <cmath>

#include "sim/base/clones.h"
#include "sim/base/hash.h"
#include "sim/imaging/float_math.h"

namespace seldinger::imaging {
namespace {

// 2u − 1 of the middle of one of 2²⁴ equal cells: exact in float, never ±1.
inline float symmetric(std::uint32_t bits) noexcept {
  return static_cast<float>(static_cast<std::int32_t>(bits >> 8) - (1 << 23)) * 0x1.0p-23F + 0x1.0p-24F;
}

// A count (or, with electronic noise, their sum) of a mean ≥ kInversionMean from a standard normal.
template <bool electronic>
inline float count_from_normal(float mean, float z, float electronic_variance) noexcept {
  if constexpr (electronic) {
    const float variance = mean + electronic_variance;
    return mean + std::sqrt(variance) * z + mean * (z * z - 1.0F) / (6.0F * variance);
  } else {
    // A twelfth of variance comes back by rounding to whole numbers.
    const float deviation = std::sqrt(mean - 1.0F / 12.0F);
    const float smooth =
        mean + deviation * z + (z * z - 1.0F) * (1.0F / 6.0F) + (z - z * z * z) / (72.0F * deviation);
    return smooth < 4194304.0F ? (smooth + 12582912.0F) - 12582912.0F : smooth;  // to the nearest whole number
  }
}

constexpr int kChunk = 256;

// counts[i] = the least k with P(X ≤ k) > u[i], for count ≤ kChunk means below kInversionMean: the sum of the
// probabilities of 0, 1, 2, … for all pixels at a time. Terms below kLeastTerm end it, so that a sum that rounding
// keeps below u does not run on; chances below that do not occur.
SELDINGER_FOR_AVX2_TOO void invert(const float* means, const float* u, int count, float* counts) noexcept {
  constexpr int kMostTerms = 50;  // P(X ≥ 50) < 1e-10 for a mean of 16
  constexpr float kLeastTerm = 1e-8F;
  float term[kChunk], below[kChunk];
  for (int i = 0; i < count; ++i) {
    term[i] = float_exp(-means[i]);
    below[i] = term[i];
    counts[i] = 0.0F;
  }
  float left = static_cast<float>(count);
  for (int k = 1; k < kMostTerms && left > 0.0F; ++k) {
    const float reciprocal = 1.0F / static_cast<float>(k);
    for (int i = 0; i < count; ++i) {
      term[i] *= means[i] * reciprocal;
      const float step = (below[i] <= u[i] ? 1.0F : 0.0F) * (term[i] > kLeastTerm ? 1.0F : 0.0F);
      counts[i] += step;
      below[i] += term[i];
    }
    if (k % 8 != 0) continue;
    left = 0.0F;
    for (int i = 0; i < count; ++i) left += below[i] <= u[i] && term[i] > kLeastTerm ? 1.0F : 0.0F;
  }
}

// Standard normals of these pixels.
SELDINGER_FOR_AVX2_TOO void normals(const std::uint32_t* pixels, int count, NoiseKey key, float* x,
                                    float* z) noexcept {
  for (int i = 0; i < count; ++i) {
    x[i] = symmetric(noise_bits(key, pixels[i]));
    z[i] = normal_quantile_middle(x[i]);
  }
}

// Every pixel as if its mean were great and its normal in the middle, in plain loops over a few hundred pixels,
// which the compiler runs four or eight at a time: same operations, same bits. Eight at a time saves 1 ms of a
// picture.
template <bool electronic>
[[gnu::always_inline]] inline void draw_most(const float* means, int count, NoiseKey key, std::uint32_t first_pixel,
                                             float electronic_variance, float* x, float* counts) noexcept {
  for (int i = 0; i < count; ++i) x[i] = symmetric(noise_bits(key, first_pixel + static_cast<std::uint32_t>(i)));
  for (int i = 0; i < count; ++i) {
    const float mean = means[i] < kInversionMean ? kInversionMean : means[i];
    counts[i] = count_from_normal<electronic>(mean, normal_quantile_middle(x[i]), electronic_variance);
  }
}

SELDINGER_FOR_AVX2_TOO void draw_most_whole(const float* means, int count, NoiseKey key, std::uint32_t first_pixel,
                                            float* x, float* counts) noexcept {
  draw_most<false>(means, count, key, first_pixel, 0.0F, x, counts);
}

SELDINGER_FOR_AVX2_TOO void draw_most_electronic(const float* means, int count, NoiseKey key,
                                                 std::uint32_t first_pixel, float electronic_variance, float* x,
                                                 float* counts) noexcept {
  draw_most<true>(means, count, key, first_pixel, electronic_variance, x, counts);
}

// The few others once more: normals in the tail, small means, and what is no mean.
template <bool electronic>
void draw_others(const float* means, int count, NoiseKey key, std::uint32_t first_pixel, float electronic_quanta,
                 const float* x, float* counts) noexcept {
  int small = 0;
  int index[kChunk];
  std::uint32_t pixels[kChunk];
  float small_mean[kChunk], u[kChunk], small_count[kChunk];
  for (int i = 0; i < count; ++i) {
    const float mean = means[i];
    if (mean >= kInversionMean && std::abs(x[i]) <= kQuantileMiddle) continue;
    if (mean >= kInversionMean) {
      counts[i] =
          count_from_normal<electronic>(mean, normal_quantile_tail(x[i]), electronic_quanta * electronic_quanta);
    } else if (!(mean >= 0.0F)) {
      counts[i] = mean < 0.0F ? 0.0F : mean;  // NaN is handed on
    } else {
      index[small] = i;
      pixels[small] = first_pixel + static_cast<std::uint32_t>(i);
      small_mean[small] = mean;
      u[small] = 0.5F + 0.5F * x[i];
      ++small;
    }
  }
  if (small == 0) return;
  invert(small_mean, u, small, small_count);
  if constexpr (electronic) {
    float other_x[kChunk], z[kChunk];
    normals(pixels, small, {key.second, key.first}, other_x, z);
    for (int at = 0; at < small; ++at) {
      if (std::abs(other_x[at]) > kQuantileMiddle) z[at] = normal_quantile_tail(other_x[at]);
      small_count[at] += electronic_quanta * z[at];
    }
  }
  for (int at = 0; at < small; ++at) counts[index[at]] = small_count[at];
}

}  // namespace

NoiseKey noise_key(std::uint64_t seed, std::uint64_t frame) noexcept {
  const std::uint64_t bits = base::hash_combine(seed, frame);
  return {static_cast<std::uint32_t>(bits), static_cast<std::uint32_t>(bits >> 32)};
}

void noisy_counts(const float* means, int count, NoiseKey key, std::uint32_t first_pixel, float electronic_quanta,
                  float* counts) noexcept {
  float x[kChunk];
  for (int done = 0; done < count; done += kChunk) {
    const int part = std::min(kChunk, count - done);
    const std::uint32_t pixel = first_pixel + static_cast<std::uint32_t>(done);
    if (electronic_quanta > 0.0F) {
      draw_most_electronic(means + done, part, key, pixel, electronic_quanta * electronic_quanta, x, counts + done);
      draw_others<true>(means + done, part, key, pixel, electronic_quanta, x, counts + done);
    } else {
      draw_most_whole(means + done, part, key, pixel, x, counts + done);
      draw_others<false>(means + done, part, key, pixel, 0.0F, x, counts + done);
    }
  }
}

}  // namespace seldinger::imaging
